// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/attack/loop.h"

#include "support/shapes.h"
#include "support/topology.h"

#include <algorithm>
#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

/// A regular one about the origin: the neighbours of a corner sum up to the corner turned round.
Surface tetrahedron()
{
    return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
}

bool has(const Points& points, const Point& wanted)
{
    return std::any_of(points.begin(), points.end(), [&](const Point& p) { return (p - wanted).norm() < 1e-12; });
}

TEST(Loop, OfATetrahedronByHand)
{
    const Surface before = tetrahedron();
    const Surface after = subdivide_by_loop(before, 1);
    ASSERT_EQ(after.points.size(), 10u);
    EXPECT_EQ(after.triangles.size(), 16u);
    for (const Point& p : before.points) // 1 - 3 * 3/16 of the corner, 3/16 of minus the corner
        EXPECT_TRUE(has(after.points, p / 4));
    for (int a = 0; a < 4; ++a) // 3/8 of the ends, 1/8 of those opposite, which are minus the ends
        for (int b = 0; b < a; ++b)
            EXPECT_TRUE(has(after.points, (before.points[a] + before.points[b]) / 4));
}

TEST(Loop, StaysClosedAndFlatWhereItIs)
{
    const Surface ball = subdivide_by_loop(shapes::sphere(1), 2);
    EXPECT_TRUE(is_closed_manifold(ball));
    EXPECT_EQ(ball.triangles.size(), 16 * shapes::sphere(1).triangles.size());
    for (const Point& p : subdivide_by_loop(shapes::triangular_grid(4, 4, 1), 2).points)
        EXPECT_EQ(p.z(), 0);
}

TEST(Loop, RefusesAnEdgeOfThreeFaces)
{
    const Surface fin = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}}, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}};
    EXPECT_THROW((void)subdivide_by_loop(fin, 1), Error);
}

} // namespace
