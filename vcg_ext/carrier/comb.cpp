// SPDX-License-Identifier: GPL-3.0-or-later
#include "comb.h"

#include "../base/median.h"
#include "../payload/code.h"
#include "statistic.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vcg_ext {

namespace {

constexpr int cells = 1 << 16;       ///< of the whole range; the narrowest carrier has some 45 of them
constexpr double most_trim = 0.15;   ///< that a key may draw
constexpr double step = 0.1;         ///< from one trim to the next, in carriers
constexpr int least_samples = 15;    ///< per carrier, on average
constexpr double fewest_samples = 4; ///< in a carrier that counts
constexpr int most_numbers = 256;    ///< of carriers: more take too long to try, and are rare

/// Sums over all values below a cell: of 1, of the value, of its square.
class RunningSums {
public:
    RunningSums(const std::vector<double>& scalar, double minimum, double maximum) : sums_(cells + 1, {0, 0, 0})
    {
        for (const double s : scalar) {
            const double x = (s - minimum) / (maximum - minimum);
            if (!(x >= 0 && x <= 1))
                continue;
            std::array<double, 3>& sum = sums_[1 + std::min(cells - 1, static_cast<int>(x * cells))];
            sum[0] += 1;
            sum[1] += x;
            sum[2] += x * x;
        }
        for (int cell = 0; cell < cells; ++cell)
            for (int power = 0; power < 3; ++power)
                sums_[cell + 1][power] += sums_[cell][power];
    }

    [[nodiscard]] double count() const { return sums_.back()[0]; }

    /// How many standard errors the statistic of the values from `begin` to `end` is off its threshold; NaN of too few.
    [[nodiscard]] double z(double begin, double end, Statistic statistic) const
    {
        const auto& from = sums_[static_cast<int>(begin * cells)];
        const auto& to = sums_[static_cast<int>(end * cells)];
        const double n = to[0] - from[0];
        if (n < fewest_samples)
            return NAN;
        const double half = (end - begin) / 2;
        const double middle = begin + half;
        const double mean = (to[1] - from[1]) / n;
        const double value = statistic == Statistic::Mean
                                 ? (mean - begin) / (end - begin)
                                 : ((to[2] - from[2]) / n - 2 * middle * mean + middle * middle) / (half * half);
        return (value - threshold(statistic)) / standard_error(statistic, static_cast<int>(n));
    }

private:
    std::vector<std::array<double, 3>> sums_;
};

/// Mean |z| of the intervals. None counts more than four times the median, or one where the shape crowds would outweigh
/// all others.
double mean_strength(const RunningSums& sums, double trim, int carriers, Statistic statistic)
{
    const double width = (1 - 2 * trim) / carriers;
    std::vector<double> strengths;
    for (int k = 0; k < carriers; ++k) {
        const double z = sums.z(trim + k * width, trim + (k + 1) * width, statistic);
        if (!std::isnan(z))
            strengths.push_back(std::abs(z));
    }
    if (strengths.empty())
        return 0;
    const double most = 4 * median(strengths);
    double sum = 0;
    for (const double strength : strengths)
        sum += std::min(strength, most);
    return sum / static_cast<double>(strengths.size());
}

} // namespace

Comb find_comb(const std::vector<double>& scalar, double minimum, double maximum)
{
    const RunningSums sums(scalar, minimum, maximum);
    Comb plainest;
    for (const int carriers : recommended_numbers()) {
        if (carriers > most_numbers || sums.count() < least_samples * carriers)
            break;
        for (const Statistic statistic : {Statistic::Mean, Statistic::Variance}) {
            std::vector<double> strengths;
            for (double trim = 0; trim <= most_trim; trim += step / carriers)
                strengths.push_back(mean_strength(sums, trim, carriers, statistic));
            const double most = *std::max_element(strengths.begin(), strengths.end());
            const Comb comb{most, most / std::max(median(std::move(strengths)), 1e-9)};
            if (comb.found() > plainest.found() ||
                (comb.found() == plainest.found() && comb.contrast > plainest.contrast))
                plainest = comb;
        }
    }
    return plainest;
}

} // namespace vcg_ext
