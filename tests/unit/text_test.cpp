// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/base/text.h"

#include <gtest/gtest.h>
#include <limits>
#include <string>

using namespace vcg_ext;

namespace {

TEST(Text, IsShortAndReadsBackAsTheNumber)
{
    EXPECT_EQ(text(0), "0");
    EXPECT_EQ(text(0.45), "0.45");
    EXPECT_EQ(text(-1), "-1");
    EXPECT_EQ(text(1000), "1000");
    EXPECT_EQ(text(1e-7), "1e-07");
    EXPECT_EQ(text(0.4500001), "0.4500001"); // not "0.45", beside "must be up to 0.45"
    EXPECT_EQ(text(std::numeric_limits<double>::infinity()), "inf");
    EXPECT_EQ(text(std::numeric_limits<double>::quiet_NaN()), "nan");
    for (const double number : {1.0 / 3, 2e300, 0.1 + 0.2, std::numeric_limits<double>::max()})
        EXPECT_EQ(std::stod(text(number)), number);
}

TEST(Text, AChanceIsRoundedUp)
{
    EXPECT_EQ(chance(-6), "p 1e-6");
    EXPECT_EQ(chance(-6.9), "p 1e-6");
    EXPECT_EQ(chance(-400.5), "p 1e-400");
}

} // namespace
