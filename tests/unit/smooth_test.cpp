// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/attack/smooth.h"
#include "vcg_ext/base/weld.h"

#include "support/shapes.h"
#include "support/topology.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

/// The neighbours of each corner are the four that are not opposite: their mean is the centre.
Surface octahedron()
{
    return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
            {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

TEST(Smooth, ShrinksAnOctahedronByLambdaEachTime)
{
    const Surface start = octahedron();
    const Points end = smooth(start, 0.3, 4);
    for (std::size_t v = 0; v < end.size(); ++v)
        EXPECT_LT((end[v] - std::pow(0.7, 4) * start.points[v]).norm(), 1e-15);
}

TEST(Smooth, WeightsAreUniformWhateverTheLengths)
{
    // A fan about vertex 0 with arms of unequal length: the hub goes to the plain mean of its neighbours.
    const Surface fan = {{{0, 0, 1}, {1, 0, 0}, {0, 3, 0}, {-7, 0, 0}, {0, -2, 0}},
                         {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
    EXPECT_LT((smooth(fan, 1, 1)[0] - Point(-1.5, 0.25, 0)).norm(), 1e-15);
}

TEST(Smooth, SoupMovesAsTheWeldedMeshDoes)
{
    const Surface ball = shapes::sphere(2);
    Surface faces = soup(ball);
    faces.points = smooth(faces, 0.5, 3);
    const Points expected = smooth(ball, 0.5, 3);
    for (std::size_t f = 0; f < ball.triangles.size(); ++f)
        for (int k = 0; k < 3; ++k)
            EXPECT_LT((faces.points[3 * f + k] - expected[ball.triangles[f][k]]).norm(), 1e-15);
    EXPECT_TRUE(is_closed_manifold(weld(faces).surface));
}

TEST(Smooth, LeavesVerticesWithoutFaces)
{
    Surface ball = shapes::sphere(1);
    ball.points.emplace_back(5, 6, 7);
    EXPECT_EQ(smooth(ball, 0.5, 3).back(), Point(5, 6, 7));
}

TEST(Taubin, OfATetrahedronByHand)
{
    // A regular one about the origin: a step by part turns it into 1 - 4/3 part of itself.
    const Surface start = {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
                           {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
    const Points end = smooth_by_taubin(start, 0.3, 4);
    const double each = (1 - 4.0 / 3 * 0.3) * (1 + 4.0 / 3 * 0.318);
    for (std::size_t v = 0; v < end.size(); ++v)
        EXPECT_LT((end[v] - std::pow(each, 4) * start.points[v]).norm(), 1e-14);
}

} // namespace
