// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/attack/resample.h"
#include "vcg_ext/base/progress.h"

#include "support/load.h"
#include "support/topology.h"
#include "vcg_ext/base/error.h"
#include "vcg_ext/geometry/closest.h"

#include <gtest/gtest.h>

#include <set>

using namespace vcg_ext;

namespace {

TEST(Resample, ReachesTheNumberOfVertices)
{
    const Surface disk = load("fandisk.off");
    for (const double part : {0.2, 1.0}) {
        const int wanted = static_cast<int>(part * static_cast<double>(disk.points.size()));
        const Surface fresh = resample(disk, wanted);
        EXPECT_NEAR(static_cast<double>(fresh.points.size()), wanted, 0.01 * wanted);
        EXPECT_TRUE(is_closed_manifold(fresh));
    }
}

TEST(Resample, TakesNewPlacesOnTheSurface)
{
    const Surface disk = load("fandisk.off");
    const auto less = [](const Point& a, const Point& b) {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    };
    const std::set<Point, decltype(less)> old(disk.points.begin(), disk.points.end(), less);
    const ClosestSearch nearest(disk);
    const double diagonal = bounding_diagonal(disk);
    const Surface fresh = resample(disk, 3000);
    int kept = 0;
    for (const Point& p : fresh.points) {
        kept += static_cast<int>(old.count(p));
        EXPECT_LT(nearest(p).distance, 2e-3 * diagonal);
    }
    EXPECT_LT(kept, 300); // some on the creases stay
}

TEST(Resample, IsCancelledWithinATry)
{
    int calls = 0;
    const Progress second_iteration = [&calls](int percent, const char*) {
        EXPECT_LT(percent, 100 / 8); // of the first of eight tries
        return ++calls < 2;
    };
    EXPECT_THROW((void)resample(load("fandisk.off"), 3000, second_iteration), Cancelled);
}

TEST(Resample, RefusesNumbersThatCannotBe)
{
    const Surface quad = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    EXPECT_THROW((void)resample(quad, 2), Error);
}

} // namespace
