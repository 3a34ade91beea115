#include "vcg_ext/metric/statistics.h"

#include "vcg_ext/error.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

#include <cmath>

using namespace vcg_ext;

namespace {

/// The tail by whole numbers of any length, rounded once.
double exact_tail(int n, int k)
{
    using Integer = boost::multiprecision::cpp_int;
    Integer choose = 1; // C(n, 0)
    Integer sum = 0;
    for (int i = 0; i <= n; ++i) {
        if (n - i >= k) // C(n, i) = C(n, n - i)
            sum += choose;
        choose = choose * (n - i) / (i + 1);
    }
    const int shift = std::max(0, static_cast<int>(sum == 0 ? 0 : msb(sum)) - 62);
    return std::ldexp(static_cast<double>(Integer(sum >> shift).convert_to<long long>()), shift - n);
}

TEST(Statistics, TailOfAFewCoins)
{
    EXPECT_DOUBLE_EQ(binomial_tail(1, 1), 0.5);
    EXPECT_DOUBLE_EQ(binomial_tail(4, 3), 5.0 / 16);
    EXPECT_DOUBLE_EQ(binomial_tail(64, 64), std::ldexp(1.0, -64));
    EXPECT_EQ(binomial_tail(64, 0), 1);
    EXPECT_EQ(binomial_tail(64, -3), 1);
    EXPECT_EQ(binomial_tail(64, 65), 0);
    EXPECT_EQ(binomial_tail(0, 0), 1);
    EXPECT_THROW((void)binomial_tail(-1, 0), Error);
}

TEST(Statistics, TailIsExactUpToTheLongestMessage)
{
    for (const int n : {1, 7, 16, 64, 255, 512, 1000})
        for (int k = 1; k <= n; k += 1 + n / 40)
            EXPECT_NEAR(binomial_tail(n, k) / exact_tail(n, k), 1, 1e-12) << k << " of " << n;
    for (const int k : {1, 400, 512, 600, 900})
        EXPECT_NEAR(binomial_tail(1024, k) / exact_tail(1024, k), 1, 1e-12) << k << " of 1024";
}

TEST(Statistics, RatioCountsMatches)
{
    EXPECT_DOUBLE_EQ(detection_ratio({1, 0, 1, 1}, {1, 0, 0, 1}), 0.75);
    EXPECT_DOUBLE_EQ(detection_ratio({}, {}), 1);
    EXPECT_THROW((void)detection_ratio({1}, {1, 0}), Error);
}

TEST(Statistics, CurveOfScoresThatDoNotOverlap)
{
    const std::vector<RocPoint> curve = roc({0.9, 1.0}, {0.4, 0.6, 0.5});
    EXPECT_EQ(curve.front().true_positive, 0);
    EXPECT_EQ(curve.back().false_positive, 1);
    EXPECT_EQ(curve.back().true_positive, 1);
    EXPECT_EQ(equal_error_rate(curve), 0);
}

TEST(Statistics, CurveOfOneScoreForAll)
{
    const std::vector<RocPoint> curve = roc({0.5, 0.5}, {0.5});
    ASSERT_EQ(curve.size(), 2u);
    EXPECT_DOUBLE_EQ(equal_error_rate(curve), 0.5);
}

TEST(Statistics, EqualErrorRateByHand)
{
    // Of four marked one lies below the 0.5 threshold, of four unmarked one lies above it: both errors are 1/4 there.
    EXPECT_DOUBLE_EQ(equal_error_rate(roc({0.9, 0.8, 0.7, 0.3}, {0.6, 0.2, 0.1, 0.4})), 0.25);
    // Scores that are worse than chance.
    EXPECT_DOUBLE_EQ(equal_error_rate(roc({0, 1}, {2, 3})), 1);
    EXPECT_THROW((void)roc({}, {1}), Error);
    EXPECT_THROW((void)roc({1}, {std::nan("")}), Error);
}

} // namespace
