// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/attack/remesh.h"
#include "vcg_ext/base/error.h"

#include "support/load.h"
#include "support/shapes.h"
#include "support/topology.h"
#include "vcg_ext/geometry/closest.h"
#include "vcg_ext/geometry/moments.h"
#include "vcg_ext/geometry/size.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

TEST(Remesh, EvensOutTheEdges)
{
    const Surface disk = load("fandisk.off");
    const double length = mean_edge_length(disk);
    const Surface even = remesh(disk, length, 5);
    EXPECT_NEAR(mean_edge_length(even), length, 0.15 * length);
    int within = 0;
    int edges = 0;
    for (const Triangle& t : even.triangles)
        for (int k = 0; k < 3; ++k, ++edges) {
            const double edge = (even.points[t[k]] - even.points[t[(k + 1) % 3]]).norm();
            within += edge > 0.5 * length && edge < 1.5 * length;
        }
    EXPECT_GT(within, 0.97 * edges);
    EXPECT_TRUE(is_closed_manifold(even));
}

TEST(Remesh, StaysOnTheSurface)
{
    const Surface ball = shapes::sphere(3);
    const ClosestSearch nearest(ball);
    const Surface even = remesh(ball, 0.15, 4);
    for (const Point& p : even.points)
        EXPECT_LT(nearest(p).distance, 1e-6); // put back on the faces
    EXPECT_EQ(euler_characteristic(even), 2);
}

/// One far vertex puts all other faces into one cell of the grid; ten radii away are borne.
TEST(Remesh, RefusesAMeshOfWhichNearlyAllIsCrowded)
{
    Surface ball = shapes::sphere(4);
    ball.points[11] *= 10;
    EXPECT_NO_THROW((void)remesh(ball, 0.3, 1));
    ball.points[11] *= 1e6;
    EXPECT_THROW((void)remesh(ball, mean_edge_length(ball), 10), Error);
}

TEST(Remesh, MeanEdgeOfABox)
{
    const double diagonals = (std::sqrt(2.0) * 6);
    EXPECT_NEAR(mean_edge_length(shapes::box(1, 1, 1)), (12 + diagonals) / 18, 1e-15);
}

} // namespace
