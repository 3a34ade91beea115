// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/attack/subdivide.h"

#include "support/load.h"
#include "support/shapes.h"
#include "support/topology.h"
#include "vcg_ext/geometry/moments.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

TEST(Subdivide, CutsEachFaceInFour)
{
    const Surface disk = load("fandisk.off");
    const Surface once = subdivide(disk, 1);
    EXPECT_EQ(once.triangles.size(), 4 * disk.triangles.size());
    EXPECT_EQ(once.points.size(),
              disk.points.size() + 3 * disk.triangles.size() / 2); // one a new edge, of two faces each
    EXPECT_TRUE(is_closed_manifold(once));
    EXPECT_NEAR(signed_volume(once), signed_volume(disk), 1e-9 * std::abs(signed_volume(disk)));
}

TEST(Subdivide, Repeats)
{
    const Surface ball = shapes::sphere(0);
    EXPECT_EQ(subdivide(ball, 3).triangles.size(), 64 * ball.triangles.size());
}

TEST(Subdivide, TakesEdgesOfThreeFaces)
{
    const Surface fin = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}}, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}};
    const Surface cut = subdivide(fin, 1);
    EXPECT_EQ(cut.triangles.size(), 12u);
    EXPECT_EQ(cut.points.size(), 5u + 7u); // the shared edge has one midpoint
}

} // namespace
