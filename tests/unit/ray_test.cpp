// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/load.h"
#include "support/shapes.h"
#include "vcg_ext/geometry/ray.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace {

using namespace vcg_ext;

/// The farthest distance along the ray at which it meets a face, by solving each face's 3 x 3 system; negative: none.
double farthest_by_elimination(const Surface& s, const Point& origin, const Point& unit)
{
    double farthest = -1;
    for (const Triangle& t : s.triangles) {
        Eigen::Matrix3d m;
        m << s.points[t[1]] - s.points[t[0]], s.points[t[2]] - s.points[t[0]], -unit;
        const Point x = m.fullPivLu().solve(origin - s.points[t[0]]);
        if (x[0] >= 0 && x[1] >= 0 && x[0] + x[1] <= 1 && x[2] >= 0)
            farthest = std::max(farthest, x[2]);
    }
    return farthest;
}

void expect_inside(const Surface& s, const SurfacePoint& hit)
{
    const Triangle& t = s.triangles[hit.face];
    const Point n = scaled_normal(s.points, t);
    const double size = std::sqrt(n.norm());
    EXPECT_LT(std::abs(n.normalized().dot(hit.position - s.points[t[0]])), 1e-9 * size);
    for (int k = 0; k < 3; ++k) {
        const Point& a = s.points[t[k]];
        const Point& b = s.points[t[(k + 1) % 3]];
        EXPECT_GE((b - a).cross(hit.position - a).dot(n), -1e-9 * n.squaredNorm());
    }
}

TEST(Ray, FarthestOfSeveralWallsFromEitherSide)
{
    Surface s = shapes::box(2, 2, 2);
    const Surface outer = shapes::moved(shapes::box(2, 2, 2), 3, 0, {1, 0, 0}, {-2, -2, -2}); // [-2, 4]^3
    for (const Triangle& t : outer.triangles)
        s.triangles.push_back({t[0] + 8, t[2] + 8, t[1] + 8}); // inside out
    s.points.insert(s.points.end(), outer.points.begin(), outer.points.end());
    const auto hit = farthest_hit(s, {1, 1, 1}, {0.2, 0.1, 5});
    ASSERT_TRUE(hit);
    EXPECT_LT((hit->position - Point(1.12, 1.06, 4)).norm(), 1e-12);
    expect_inside(s, *hit);
}

TEST(Ray, MeetsTheSameFaceInAnyUnit)
{
    const Surface surface = load("fandisk.off");
    Point origin = Point::Zero();
    for (const Point& p : surface.points)
        origin += p / static_cast<double>(surface.points.size());
    for (const Point& direction : {Point(1, 2, 3), Point(-3, 1, 0.5), Point(0.2, -1, -0.7)}) {
        const auto hit = farthest_hit(surface, origin, direction);
        ASSERT_TRUE(hit);
        for (const double unit : {0x1p-30, 0x1p-10, 0x1p20}) {
            Surface other = surface;
            for (Point& p : other.points)
                p *= unit;
            const auto same = farthest_hit(other, unit * origin, direction);
            ASSERT_TRUE(same) << unit;
            EXPECT_EQ(same->face, hit->face) << unit;
            EXPECT_EQ(same->position, unit * hit->position) << unit;
        }
    }
}

TEST(Ray, MissesWhatLiesBehindOrBeside)
{
    const Surface s = shapes::box(1, 1, 1);
    EXPECT_FALSE(farthest_hit(s, {0.5, 0.5, 2}, {0, 0, 1}));
    EXPECT_FALSE(farthest_hit(s, {0.5, 0.5, 2}, {1, 0, -1}));
    EXPECT_TRUE(farthest_hit(s, {0.5, 0.4, 2}, {0, 0, -1}));
}

TEST(Ray, AgreesWithEliminationOnARealMesh)
{
    const Surface s = load("elephant.off");
    std::mt19937 draws(1);
    std::uniform_real_distribution<double> side(-1, 1);
    const Point centre = s.points[0];
    for (int i = 0; i < 100; ++i) {
        const Point unit = Point(side(draws), side(draws), side(draws)).normalized();
        const Point origin = centre + 0.2 * bounding_diagonal(s) * Point(side(draws), side(draws), side(draws));
        const auto hit = farthest_hit(s, origin, unit);
        const double farthest = farthest_by_elimination(s, origin, unit);
        ASSERT_EQ(hit.has_value(), farthest >= 0);
        if (hit) {
            EXPECT_NEAR((hit->position - origin).norm(), farthest, 1e-9);
            expect_inside(s, *hit);
        }
    }
}

} // namespace
