// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/attack/sqrt3.h"

#include "support/load.h"
#include "support/shapes.h"
#include "support/topology.h"
#include "vcg_ext/geometry/moments.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

TEST(Sqrt3, OfATetrahedronByHand)
{
    // A regular one about the origin: the mean of a corner's neighbours is minus a third of it, and 5/9 of the way go
    // there.
    const Surface before = {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
                            {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
    const Surface after = subdivide_by_sqrt3(before, 1);
    ASSERT_EQ(after.points.size(), 8u);
    for (int v = 0; v < 4; ++v) {
        EXPECT_LT((after.points[v] - 7.0 / 27 * before.points[v]).norm(), 1e-15);
        EXPECT_LT((after.points[4] + before.points[3] / 3).norm(), 1e-15); // opposite to the last corner
    }
    EXPECT_EQ(after.triangles.size(), 12u);
    EXPECT_TRUE(is_closed_manifold(after));
    EXPECT_GT(signed_volume(after) * signed_volume(before), 0);
}

TEST(Sqrt3, TwiceCutsEachEdgeInThree)
{
    const Surface disk = load("fandisk.off");
    const Surface twice = subdivide_by_sqrt3(disk, 2);
    EXPECT_EQ(twice.triangles.size(), 9 * disk.triangles.size());
    EXPECT_EQ(twice.points.size(), disk.points.size() + 4 * disk.triangles.size());
    EXPECT_TRUE(is_closed_manifold(twice));
}

TEST(Sqrt3, BordersAndEdgesOfThreeFacesStay)
{
    const Surface grid = shapes::triangular_grid(4, 4, 1);
    const Surface cut = subdivide_by_sqrt3(grid, 1);
    double area = 0;
    for (const Triangle& t : cut.triangles)
        area += (cut.points[t[1]] - cut.points[t[0]]).cross(cut.points[t[2]] - cut.points[t[0]]).z() / 2;
    EXPECT_NEAR(area, static_cast<double>(grid.triangles.size()) * std::sqrt(3) / 4, 1e-12);
    const Surface fin = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}}, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}};
    const Surface after = subdivide_by_sqrt3(fin, 1);
    EXPECT_EQ(after.triangles.size(), 9u);
    for (int v = 0; v < 5; ++v)
        EXPECT_EQ(after.points[v], fin.points[v]);
}

} // namespace
