// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/attack/noise.h"
#include "vcg_ext/base/weld.h"
#include "vcg_ext/geometry/centre.h"

#include "support/load.h"
#include "support/shapes.h"
#include "support/topology.h"
#include "vcg_ext/carrier/shells.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

TEST(Noise, MovesEveryVertexByTheAmountTimesTheFarthestNorm)
{
    const Surface bunny = load("bunny00.off");
    const Point centre = area_centre(bunny.points, bunny.triangles);
    double farthest = 0;
    for (const Point& p : bunny.points)
        farthest = std::max(farthest, (p - centre).norm());
    const Points moved = noise(bunny, 0.003, 1);
    for (std::size_t v = 0; v < moved.size(); ++v)
        ASSERT_NEAR((moved[v] - bunny.points[v]).norm(), 0.003 * farthest, 1e-12 * farthest);
}

TEST(Noise, DirectionsAreUniform)
{
    // Of n uniform unit vectors the mean has the variance 1 / (3 n) per axis, and the mean of x^2 is 1 / 3 with the
    // variance 4 / (45 n). Five standard errors.
    const Surface bunny = load("bunny00.off");
    const Points moved = noise(bunny, 0.003, 7);
    const double n = static_cast<double>(moved.size());
    Point mean = Point::Zero();
    Point squares = Point::Zero();
    for (std::size_t v = 0; v < moved.size(); ++v) {
        const Point d = (moved[v] - bunny.points[v]).normalized();
        mean += d / n;
        squares += d.cwiseAbs2() / n;
    }
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(mean[axis], 0, 5 * std::sqrt(1 / (3 * n)));
        EXPECT_NEAR(squares[axis], 1.0 / 3, 5 * std::sqrt(4 / (45 * n)));
    }
}

TEST(Noise, SeedsDiffer)
{
    const Surface ball = shapes::sphere(2);
    EXPECT_EQ(noise(ball, 0.01, 3), noise(ball, 0.01, 3));
    EXPECT_NE(noise(ball, 0.01, 3), noise(ball, 0.01, 4));
}

TEST(Noise, SoupStaysClosed)
{
    Surface faces = soup(shapes::sphere(2));
    faces.points = noise(faces, 0.01, 3);
    EXPECT_TRUE(is_closed_manifold(weld(faces).surface));
}

} // namespace
