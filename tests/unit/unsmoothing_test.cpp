// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/geometry/unsmoothing.h"

#include "support/shapes.h"
#include "vcg_ext/geometry/umbrella.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

Surface bumpy(int level)
{
    Surface s = shapes::sphere(level);
    for (Point& p : s.points)
        p = Point((1 + 0.1 * std::sin(5 * p.x()) * std::cos(4 * p.y() + 1)) * p).cwiseProduct(Point(1.3, 1, 0.8));
    return s;
}

TEST(Unsmoothing, FindsTheRoundsAndThePlacesOfPointsThatWereSmoothed)
{
    constexpr int rounds = 6;
    const FootSearch original(bumpy(5));
    Surface copy = bumpy(3); // edges of its own
    Points places;
    for (const Point& p : copy.points)
        places.push_back(original(p, 1).point);
    const EdgeGraph graph = edge_graph(copy);
    copy.points = places;
    for (int round = 0; round < rounds; ++round)
        copy.points = umbrella_step(graph, copy.points, 0.5);

    const std::vector<Unsmoothed> ways = unsmoothings(original, 1, copy, graph, 4);
    ASSERT_FALSE(ways.empty());
    EXPECT_EQ(ways.front().rounds, rounds);
    double was = 0; // how far smoothing took the points, and how far from home they are found
    double is = 0;
    for (std::size_t v = 0; v < places.size(); ++v) {
        was += (copy.points[v] - places[v]).squaredNorm();
        is += (ways.front().feet[v].point - places[v]).squaredNorm();
    }
    EXPECT_LT(is, was / 25);
    for (std::size_t i = 1; i < ways.size(); ++i)
        EXPECT_GT(ways[i].spread, ways.front().spread);
}

} // namespace
