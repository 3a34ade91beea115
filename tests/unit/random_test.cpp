// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/key/random.h"
#include "vcg_ext/key/stream.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

TEST(Random, PurposesSeedsAndPartsAreApart)
{
    const std::uint64_t first = seeded_stream(1, "noise").next();
    EXPECT_EQ(first, seeded_stream(1, "noise", 0).next());
    EXPECT_NE(first, seeded_stream(2, "noise").next());
    EXPECT_NE(first, seeded_stream(1, "crop").next());
    EXPECT_NE(first, seeded_stream(1, "noise", 1).next());
}

TEST(Random, UniformIsUniform)
{
    Stream draws = seeded_stream(3, "test");
    constexpr int n = 100000;
    std::vector<int> tenths(10, 0);
    for (int i = 0; i < n; ++i) {
        const double u = uniform(draws);
        ASSERT_GE(u, 0);
        ASSERT_LT(u, 1);
        ++tenths[static_cast<int>(10 * u)];
    }
    double chi_squared = 0;
    for (const int count : tenths)
        chi_squared += (count - n / 10.0) * (count - n / 10.0) / (n / 10.0);
    EXPECT_LT(chi_squared, 33.7); // nine degrees of freedom, p = 1e-4
}

TEST(Random, DirectionsAreOfUnitLength)
{
    Stream draws = seeded_stream(4, "test");
    for (int i = 0; i < 1000; ++i) {
        EXPECT_NEAR(direction<3>(draws).norm(), 1, 1e-15);
        EXPECT_NEAR(direction<4>(draws).norm(), 1, 1e-15);
    }
}

TEST(Random, IntegerDirectionsAreTheFormats)
{
    Stream draws = seeded_stream(4, "test");
    EXPECT_EQ(integer_direction(draws), Point(535779, -477669, 564160));
    EXPECT_EQ(integer_direction(draws), Point(654940, 752227, 162128));
    Point mean = Point::Zero();
    constexpr int count = 10000;
    for (int i = 0; i < count; ++i)
        mean += integer_direction(draws).normalized() / count;
    EXPECT_LT(mean.norm(), std::sqrt(16.3 / (3 * count))); // 3 n |mean|^2 is chi^2 of 3 degrees: p = 1e-3
}

} // namespace
