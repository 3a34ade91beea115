// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/base/weld.h"
#include "vcg_ext/geometry/closest.h"
#include "vcg_ext/key/stream.h"

#include "support/load.h"
#include "support/shapes.h"
#include "vcg_ext/base/error.h"
#include "vcg_ext/key/random.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

/// Distance to a triangle by its definition: the least over its inside, its edges and its corners.
double distance_to(const Point& p, const Point& a, const Point& b, const Point& c)
{
    const auto to_segment = [&](const Point& from, const Point& to) {
        const Point way = to - from;
        const double t = std::clamp((p - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
        return (from + t * way - p).norm();
    };
    double least = std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
    const Point n = (b - a).cross(c - a).normalized();
    const Point foot = p - n.dot(p - a) * n;
    if ((b - a).cross(foot - a).dot(n) >= 0 && (c - b).cross(foot - b).dot(n) >= 0 &&
        (a - c).cross(foot - c).dot(n) >= 0)
        least = std::min(least, std::abs(n.dot(p - a)));
    return least;
}

void compare_with_all_faces(const Surface& surface, int points)
{
    const ClosestSearch nearest(surface);
    const double diagonal = bounding_diagonal(surface);
    Stream draws = seeded_stream(1, "closest test");
    for (int i = 0; i < points; ++i) {
        const Point p = surface.points[draws.below(surface.points.size())] +
                        std::pow(10, -5 * uniform(draws)) * diagonal * direction<3>(draws);
        double least = std::numeric_limits<double>::infinity();
        for (const Triangle& t : surface.triangles)
            least = std::min(least, distance_to(p, surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]));
        const ClosestPoint found = nearest(p);
        EXPECT_NEAR(found.distance, least, 1e-6 * least);
        EXPECT_NEAR((found.point - p).norm(), least, 1e-6 * least + 1e-12 * diagonal);
        const Triangle& t = surface.triangles[found.face];
        EXPECT_NEAR(distance_to(found.point, surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]), 0,
                    1e-9 * diagonal);
        EXPECT_EQ(nearest(p, 0.99 * least).face, -1);
        EXPECT_NEAR(nearest(p, 1.01 * least).distance, least, 1e-6 * least);
    }
}

TEST(Closest, AgreesWithAskingEveryFace)
{
    compare_with_all_faces(shapes::sphere(3), 300);
    compare_with_all_faces(load("fandisk.off"), 200);
    compare_with_all_faces(weld(load("anchor.off")).surface, 300);
}

TEST(Closest, TakesNeedlesForEdges)
{
    // Beside a face lies a needle to (0, 9, 5), its corners in any order; its box's diagonal is elsewhere.
    const Points points = {{0, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 9, 5}, {0, 4.5, 2.5}};
    for (const Triangle& needle : {Triangle{0, 3, 4}, Triangle{4, 0, 3}, Triangle{3, 0, 4}, Triangle{0, 3, 3}}) {
        const ClosestSearch nearest(Surface{points, {{0, 1, 2}, needle}});
        const ClosestPoint found = nearest(Point(2, 4.5, 2.5));
        EXPECT_NEAR(found.distance, 2, 1e-6);
        EXPECT_EQ(found.face, 1);
        EXPECT_NEAR((found.point - points[4]).norm(), 0, 1e-9);
        EXPECT_NEAR(
            nearest(Point(0.25, -0.25, 3)).distance,
            std::hypot(0.25,
                       (Point(0, -0.25, 3) - Point(0, 9, 5) * (Point(0, -0.25, 3).dot(Point(0, 9, 5)) / 106)).norm()),
            1e-6);
    }
}

TEST(Closest, TakesManyFacesInOnePlace)
{
    // A hundred faces about one vertex, and a hundred that lie on each other.
    Surface fan;
    fan.points.emplace_back(0, 0, 0);
    for (int i = 0; i < 100; ++i) {
        fan.points.emplace_back(std::cos(0.0628 * i), std::sin(0.0628 * i), 0.01 * (i % 2));
        fan.triangles.push_back({0, 1 + i, 1 + (i + 1) % 100});
    }
    for (int i = 0; i < 100; ++i)
        fan.triangles.push_back({1, 34, 67});
    compare_with_all_faces(fan, 200);
}

TEST(Closest, PrefersAFaceToANeedleOnItsEdge)
{
    const Surface surface = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}}, {{0, 1, 3}, {0, 1, 2}}};
    EXPECT_EQ(ClosestSearch(surface)({0.3, -1, 0}).face, 1);
    EXPECT_THROW(ClosestSearch({surface.points, {{0, 1, 3}}}), Error);
}

} // namespace
