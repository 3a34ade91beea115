// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/payload/binomial.h"
#include "vcg_ext/payload/sum_tails.h"

#include <cmath>
#include <gtest/gtest.h>

namespace {

using namespace vcg_ext;

TEST(SumTails, EqualSignsAreBoundedAboveTheBinomialTail)
{
    for (const int n : {8, 64, 200})
        for (int k = n / 2 + 1; k <= n; ++k) {
            const double bound = log_tail_of_signs(std::vector<double>(n, 0.7), 0.7 * (2 * k - n));
            const double exact = std::log(binomial_tail(n, k));
            EXPECT_GE(bound, exact - 1e-9) << n << ' ' << k;
            EXPECT_LT(bound, exact + 3.5) << n << ' ' << k; // Chernoff's prefactor
        }
}

TEST(SumTails, AllSignsRightIsOneOfAllSigns)
{
    const std::vector<double> l{0.3, 0.9, 0.01, 0.5, 0.7};
    EXPECT_NEAR(log_tail_of_signs(l, 0.3 + 0.9 + 0.01 + 0.5 + 0.7), -5 * std::log(2.0), 0.1);
    EXPECT_EQ(log_tail_of_signs(l, 0), 0);
    EXPECT_EQ(log_tail_of_signs(l, -1), 0);
}

TEST(SumTails, ClassicalBoundsLieAbove)
{
    // Hoeffding's bound is looser for signs; and the tail of cosines is below that of the normal bound exp(-s^2 / n).
    std::vector<double> l;
    double squares = 0;
    for (int i = 0; i < 64; ++i) {
        l.push_back(std::cos(i * 1.7));
        squares += l.back() * l.back();
    }
    for (double s = 1; s < 30; s += 0.5) {
        EXPECT_LE(log_tail_of_signs(l, s), -s * s / (2 * squares) + 1e-9);
        EXPECT_LE(log_tail_of_cosines(64, s), -s * s / 64 + 1e-9);
    }
}

TEST(SumTails, TwoCosinesAreBoundedAboveTheExactTail)
{
    // P(cos a >= s) = acos(s) / pi.
    for (double s = 0.01; s < 1; s += 0.01)
        EXPECT_GE(log_tail_of_cosines(1, s), std::log(std::acos(s) / 3.14159265358979323846));
}

TEST(SumTails, TheTableIsABoundAndNear)
{
    const CosineTail table(64);
    for (double s = -3; s < 63.5; s += 0.037) {
        const double least = log_tail_of_cosines(64, s);
        EXPECT_GE(table(s), least - 1e-6) << s;
        EXPECT_LE(table(s), least + 0.05 + 0.02 * std::abs(least)) << s;
    }
}

} // namespace
