// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/load.h"
#include "vcg_ext/metric/displacement.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

double mrms(const Surface& surface, const Points& moved)
{
    return local_mrms(surface.points, moved, surface.triangles,
                      vertex_faces(static_cast<int>(moved.size()), surface.triangles));
}

/// A flat square of n x n cells.
Surface plate(int n)
{
    Surface surface;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            surface.points.emplace_back(i, j, 0);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const int a = i * (n + 1) + j;
            const int b = a + n + 1;
            surface.triangles.push_back({a, b, b + 1});
            surface.triangles.push_back({a, b + 1, a + 1});
        }
    return surface;
}

TEST(LocalMrms, OfALiftedPlateIsTheLift)
{
    const Surface surface = plate(20);
    Points lifted = surface.points;
    for (Point& p : lifted)
        p.z() += 0.01;
    EXPECT_NEAR(mrms(surface, lifted), 0.01, 1e-12);
}

TEST(LocalMrms, OfATiltedPlateIsTheRootOfAThird)
{
    // Lifted by h x / n: the mean of the square over the plate is h^2 / 3, the distances are the lift times cos(tilt).
    const Surface surface = plate(20);
    const double h = 0.1;
    Points tilted = surface.points;
    for (Point& p : tilted)
        p.z() = h * p.x() / 20;
    EXPECT_NEAR(mrms(surface, tilted), h / std::sqrt(3.0), 1e-3 * h);
}

TEST(LocalMrms, SlidingInThePlaneCostsNothing)
{
    const Surface surface = plate(20);
    Points slid = surface.points;
    for (Point& p : slid)
        if (p.x() > 0 && p.x() < 20 && p.y() > 0 && p.y() < 20)
            p += Point(0.2, -0.1, 0);
    EXPECT_LT(mrms(surface, slid), 1e-15);
    EXPECT_NEAR(max_displacement(surface.points, slid), std::sqrt(0.05), 1e-15);
    EXPECT_EQ(moved_count(surface.points, slid), 19 * 19);
}

} // namespace
