// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/attack/isosurface.h"
#include "vcg_ext/base/error.h"
#include "vcg_ext/base/weld.h"

#include "support/load.h"
#include "support/shapes.h"
#include "support/topology.h"
#include "vcg_ext/geometry/moments.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

TEST(Isosurface, OfASphereIsASphere)
{
    const Surface ball = shapes::sphere(5); // within 4e-4 of the round one
    const double cell = 0.05;
    const Surface anew = isosurface(ball, cell);
    EXPECT_TRUE(is_closed_manifold(anew));
    EXPECT_EQ(euler_characteristic(anew), 2);
    for (const Point& p : anew.points)
        EXPECT_NEAR(p.norm(), 1, cell * cell / 8 + 1e-3); // a chord's height over a cell
    EXPECT_NEAR(signed_volume(anew), signed_volume(ball), 5e-3 * signed_volume(ball));
}

TEST(Isosurface, DoesNotMindOrientation)
{
    Surface inside_out = shapes::sphere(3);
    for (std::size_t f = 0; f < inside_out.triangles.size(); f += 2)
        std::swap(inside_out.triangles[f][0], inside_out.triangles[f][1]);
    const Surface anew = isosurface(inside_out, 0.1);
    EXPECT_EQ(anew.triangles, isosurface(shapes::sphere(3), 0.1).triangles);
    EXPECT_GT(signed_volume(anew), 0); // outwards
}

TEST(Isosurface, KeepsACavity)
{
    const Surface hollow = joined(shapes::sphere(3), shapes::moved(shapes::sphere(3), 0.5, 0, {0, 0, 1}, {0, 0, 0}));
    const Surface anew = isosurface(hollow, 0.05);
    EXPECT_TRUE(is_closed_manifold(anew));
    EXPECT_EQ(euler_characteristic(anew), 4);
    const double solid = signed_volume(shapes::sphere(3));
    EXPECT_NEAR(signed_volume(anew), solid * (1 - 0.125), 0.01 * solid);
}

TEST(Isosurface, OfRealMeshesIsClosedAndTwoManifold)
{
    for (const char* mesh : {"fandisk.off", "elephant.off", "anchor.off", "hand.off"}) {
        const Surface original = weld(load(mesh)).surface;
        const Surface anew = isosurface(original, 0.015 * bounding_diagonal(original));
        EXPECT_TRUE(is_closed_manifold(anew)) << mesh;
        const double volume = std::abs(signed_volume(original, original.points[0]));
        EXPECT_NEAR(signed_volume(anew, anew.points[0]), volume, 0.03 * volume) << mesh;
    }
}

TEST(Isosurface, RefusesOpenMeshesAndCellsThatMissTheSurface)
{
    Surface open = shapes::sphere(2);
    open.triangles.pop_back();
    EXPECT_THROW((void)isosurface(open, 0.1), Error);
    EXPECT_THROW((void)isosurface(shapes::box(1, 1, 1e-6), 0.1), Error);
}

} // namespace
