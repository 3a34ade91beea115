// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/shapes.h"
#include "vcg_ext/geometry/normal_smoothing.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace vcg_ext;

namespace {

Points smoothed(const Surface& s, int rounds)
{
    const Fans fans = fans_of(vertex_faces(static_cast<int>(s.points.size()), s.triangles), s.triangles);
    return smoothed_along_normals(s.points, fans, rounds, 0.5);
}

TEST(NormalSmoothing, LeavesAPlaneAloneHoweverItIsSampled)
{
    Surface s = shapes::triangular_grid(2, 2, 0.1);
    std::mt19937 draws(1);
    for (Point& p : s.points)
        p += 0.02 * Point(draws() % 100 / 100.0, draws() % 100 / 100.0, 0);
    const Points smooth = smoothed(s, 3);
    for (std::size_t v = 0; v < smooth.size(); ++v)
        EXPECT_LT((smooth[v] - s.points[v]).norm(), 1e-15);
}

TEST(NormalSmoothing, TakesRoughnessAway)
{
    Surface s = shapes::sphere(4);
    std::mt19937 draws(1);
    std::normal_distribution<double> noise(0, 0.01);
    for (Point& p : s.points)
        p *= 1 + noise(draws);
    const auto roughness = [&](const Points& points) {
        double sum = 0;
        for (const Point& p : points)
            sum += (p.norm() - 1) * (p.norm() - 1);
        return std::sqrt(sum / static_cast<double>(points.size()));
    };
    EXPECT_LT(roughness(smoothed(s, 3)), 0.6 * roughness(s.points));
}

TEST(NormalSmoothing, MovesAlongTheNormalsOnly)
{
    const Surface s = shapes::sphere(3);
    const Points smooth = smoothed(s, 1);
    for (std::size_t v = 0; v < smooth.size(); ++v) {
        EXPECT_LT(smooth[v].norm(), s.points[v].norm());
        EXPECT_LT(smooth[v].cross(s.points[v]).norm(), 0.002);
    }
}

TEST(NormalSmoothing, NoRoundsAreNoChange)
{
    const Surface s = shapes::sphere(2);
    EXPECT_EQ(smoothed(s, 0), s.points);
}

} // namespace
