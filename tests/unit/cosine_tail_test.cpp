// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/base/pi.h"
#include "vcg_ext/payload/cosine_tail.h"

#include <cmath>
#include <gtest/gtest.h>

namespace {

using namespace vcg_ext;

TEST(CosineTail, TheNormalBoundLiesAbove)
{
    for (double s = 1; s < 30; s += 0.5)
        EXPECT_LE(log_tail_of_cosines(64, s), -s * s / 64 + 1e-9);
}

TEST(CosineTail, TwoCosinesAreBoundedAboveTheExactTail)
{
    // P(cos a >= s) = acos(s) / pi.
    for (double s = 0.01; s < 1; s += 0.01)
        EXPECT_GE(log_tail_of_cosines(1, s), std::log(std::acos(s) / pi));
}

TEST(CosineTail, TheTableIsABoundAndNear)
{
    const CosineTail table(64);
    for (double s = -3; s < 63.5; s += 0.037) {
        const double least = log_tail_of_cosines(64, s);
        EXPECT_GE(table(s), least - 1e-6) << s;
        EXPECT_LE(table(s), least + 0.05 + 0.02 * std::abs(least)) << s;
    }
}

} // namespace
