#include "statistics.h"

#include "../error.h"

#include <boost/math/distributions/binomial.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace vcg_ext {

double binomial_tail(int n, int k)
{
    if (n < 0)
        throw Error("A number of bits cannot be negative.");
    if (k <= 0)
        return 1;
    if (k > n)
        return 0;
    namespace policies = boost::math::policies;
    using InDouble = policies::policy<policies::promote_double<false>>; // `long double` differs between platforms
    const boost::math::binomial_distribution<double, InDouble> coins(n, 0.5);
    return cdf(complement(coins, k - 1));
}

int matching_bits(const Bits& expected, const Bits& found)
{
    if (expected.size() != found.size())
        throw Error("Messages of " + std::to_string(expected.size()) + " and " + std::to_string(found.size()) +
                    " bits cannot be compared. Pad the shorter one.");
    int matches = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
        matches += expected[i] == found[i];
    return matches;
}

double detection_ratio(const Bits& expected, const Bits& found)
{
    const int matches = matching_bits(expected, found);
    return expected.empty() ? 1 : static_cast<double>(matches) / static_cast<double>(expected.size());
}

std::vector<RocPoint> roc(const std::vector<double>& marked, const std::vector<double>& unmarked)
{
    const auto usable = [](const std::vector<double>& scores) {
        return !scores.empty() && std::none_of(scores.begin(), scores.end(), [](double s) { return std::isnan(s); });
    };
    if (!usable(marked) || !usable(unmarked))
        throw Error("An ROC curve needs scores of marked and of unmarked meshes, and each must be a number.");

    std::vector<double> positive = marked;
    std::vector<double> negative = unmarked;
    std::sort(positive.begin(), positive.end(), std::greater<>());
    std::sort(negative.begin(), negative.end(), std::greater<>());
    std::vector<RocPoint> curve = {{std::numeric_limits<double>::infinity(), 0, 0}};
    std::size_t p = 0;
    std::size_t n = 0;
    while (p < positive.size() || n < negative.size()) {
        const double threshold = p == positive.size()   ? negative[n]
                                 : n == negative.size() ? positive[p]
                                                        : std::max(positive[p], negative[n]);
        while (p < positive.size() && positive[p] >= threshold)
            ++p;
        while (n < negative.size() && negative[n] >= threshold)
            ++n;
        curve.push_back({threshold, static_cast<double>(n) / static_cast<double>(negative.size()),
                         static_cast<double>(p) / static_cast<double>(positive.size())});
    }
    return curve;
}

double equal_error_rate(const std::vector<RocPoint>& curve)
{
    // false_positive - (1 - true_positive) rises from -1 to 1 along the curve; the rate is where it is zero.
    for (std::size_t i = 1; i < curve.size(); ++i) {
        const double before = curve[i - 1].false_positive + curve[i - 1].true_positive - 1;
        const double after = curve[i].false_positive + curve[i].true_positive - 1;
        if (after >= 0) {
            const double part = before < 0 ? -before / (after - before) : 0;
            return curve[i - 1].false_positive + part * (curve[i].false_positive - curve[i - 1].false_positive);
        }
    }
    throw Error("An equal error rate needs a whole ROC curve, from (0, 0) to (1, 1).");
}

} // namespace vcg_ext
