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
    const Shells here = shells(bunny.points, bunny.triangles, 0.1, 64);
    const Shells there = shells(moved, bunny.triangles, 0.1, 64);
    EXPECT_LT((3.7 * (turn * here.centre) + Point(10, -20, 30) - there.centre).norm(), 1e-12);
    EXPECT_NEAR(there.carriers.width, 3.7 * here.carriers.width, 1e-12);
    EXPECT_EQ(here.carriers.label, there.carriers.label);
}

TEST(Shells, DoNotDependOnTheNumberOfThreads)
{
    const Surface bunny = load("bunny00.off");
    set_threads(1);
    const Shells alone = shells(bunny.points, bunny.triangles, 0.1, 64);
    set_threads(3);
    const Shells together = shells(bunny.points, bunny.triangles, 0.1, 64);
    set_threads(0);
    EXPECT_EQ(alone.centre, together.centre);
    EXPECT_EQ(alone.carriers.value, together.carriers.value);
}

TEST(Shells, RefuseASphereAndAFlatNothing)
{
    const Surface octahedron = load("octahedron.off");
    EXPECT_THROW((void)shells(octahedron.points, octahedron.triangles, 0.1, 8), Error);
    EXPECT_THROW((void)shells({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}, 0.1, 8), Error);
}

} // namespace
