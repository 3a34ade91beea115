// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/payload/binomial.h"

#include "vcg_ext/base/error.h"

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

TEST(Binomial, TailOfAFewCoins)
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

TEST(Binomial, TailIsExactUpToTheLongestMessage)
{
    for (const int n : {1, 7, 16, 64, 255, 512, 1000})
        for (int k = 1; k <= n; k += 1 + n / 40)
            EXPECT_NEAR(binomial_tail(n, k) / exact_tail(n, k), 1, 1e-12) << k << " of " << n;
    for (const int k : {1, 400, 512, 600, 900})
        EXPECT_NEAR(binomial_tail(1024, k) / exact_tail(1024, k), 1, 1e-12) << k << " of 1024";
}

TEST(Binomial, MatchesAreCounted)
{
    EXPECT_EQ(matching_bits({1, 0, 1, 1}, {1, 0, 0, 1}), 3);
    EXPECT_EQ(matching_bits({}, {}), 0);
    EXPECT_THROW((void)matching_bits({1}, {1, 0}), Error);
}

} // namespace
