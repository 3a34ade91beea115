// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/load.h"
#include "vcg_ext/base/error.h"
#include "vcg_ext/base/parallel.h"
#include "vcg_ext/carrier/shells.h"
#include "vcg_ext/geometry/centre.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

// A pyramid over the unit square, worked out by hand: sum A(v) v over sum A(v) with A(v) the areas of the
// faces around v.
TEST(AreaCentre, OfAPyramid)
{
    const Surface pyramid{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}},
                          {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
    const double side = std::sqrt(1.25) / 2; // area of each slanted face
    const double total = 3 * (1 + 4 * side);
    const Point centre = area_centre(pyramid.points, pyramid.triangles);
    EXPECT_NEAR(centre.x(), 0.5, 1e-15);
    EXPECT_NEAR(centre.y(), 0.5, 1e-15);
    EXPECT_NEAR(centre.z(), 4 * side / total, 1e-15);
}

TEST(Shells, TurnAndScaleWithTheMesh)
{
    const Surface bunny = load("bunny00.off");
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Point(1, 2, 3).normalized()).toRotationMatrix();
    Points moved = bunny.points;
    for (Point& p : moved)
        p = 3.7 * (turn * p) + Point(10, -20, 30);
    const ShellFrame here = shell_frame(bunny);
    const ShellFrame there = shell_frame(moved, bunny.triangles, hole_fans(bunny));
    const Carriers before = shells(bunny.points, here, 0.1, 64);
    const Carriers after = shells(moved, there, 0.1, 64);
    EXPECT_LT((3.7 * (turn * here.centre) + Point(10, -20, 30) - there.centre).norm(), 1e-12);
    EXPECT_NEAR(after.width, 3.7 * before.width, 1e-12);
    EXPECT_EQ(before.label, after.label);
}

TEST(Shells, DoNotDependOnTheNumberOfThreads)
{
    const Surface bunny = load("bunny00.off");
    set_threads(1);
    const ShellFrame alone = shell_frame(bunny);
    const Carriers carriers_alone = shells(bunny.points, alone, 0.1, 64);
    set_threads(3);
    const ShellFrame together = shell_frame(bunny);
    const Carriers carriers_together = shells(bunny.points, together, 0.1, 64);
    set_threads(0);
    EXPECT_EQ(alone.centre, together.centre);
    EXPECT_EQ(carriers_alone.value, carriers_together.value);
}

TEST(Shells, RefuseASphereAndAFlatNothing)
{
    const Surface octahedron = load("octahedron.off");
    EXPECT_THROW((void)shell_frame(octahedron), Error);
    const Surface nothing{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
    EXPECT_THROW((void)shell_frame(nothing), Error);
}

} // namespace
