// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/shapes.h"
#include "vcg_ext/geometry/boundary.h"
#include "vcg_ext/geometry/solid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace {

using namespace vcg_ext;

using shapes::box;

/// A tetrahedron without symmetry.
Surface tetrahedron()
{
    return {{{0, 0, 0}, {3, 0.2, 0.1}, {0.3, 1.7, 0}, {0.5, 0.1, 0.8}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

void turn_inside_out(Surface& s)
{
    for (Triangle& t : s.triangles)
        std::swap(t[1], t[2]);
}

Surface moved(Surface s, double scale, const Eigen::Matrix3d& rotation, const Point& shift)
{
    for (Point& p : s.points)
        p = scale * rotation * p + shift;
    return s;
}

TEST(Moments, BoxHasItsTextbookMoments)
{
    const Frame frame = principal_frame(box(3, 2, 1));
    EXPECT_TRUE(frame.from_volume);
    EXPECT_NEAR(frame.measure, 6, 1e-12);
    EXPECT_LT((frame.centre - Point(1.5, 1, 0.5)).norm(), 1e-12);
    EXPECT_LT((frame.variances - Point(9, 4, 1) / 12).norm(), 1e-12);
    EXPECT_LT(frame.third_moments.norm(), 1e-12);
    EXPECT_LT((frame.axes.cwiseAbs() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

TEST(Moments, SurfaceOfAnOpenRectangle)
{
    const Surface s{{{0, 0, 5}, {4, 0, 5}, {4, 2, 5}, {0, 2, 5}}, {{0, 1, 2}, {0, 2, 3}}};
    const Frame frame = area_frame(s.points, s.triangles);
    EXPECT_FALSE(principal_frame(s).from_volume);
    EXPECT_LT((principal_frame(s).variances - frame.variances).norm(), 1e-12); // the fan is the rectangle once more
    EXPECT_FALSE(frame.from_volume);
    EXPECT_NEAR(frame.measure, 8, 1e-12);
    EXPECT_LT((frame.centre - Point(2, 1, 5)).norm(), 1e-12);
    EXPECT_LT((frame.variances - Point(16.0 / 12, 4.0 / 12, 0)).norm(), 1e-12);
}

TEST(Moments, ThirdMomentOfATriangle)
{
    // Over the right triangle (0,0), (1,0), (0,1), x + y is 1 - w with w from Beta(1, 2), whose third central moment is
    // 1/135. So along (1,1)/sqrt 2 it is 1/135 / 2^1.5 towards the origin, and along (1,-1)/sqrt 2 it is 0.
    const Frame frame = principal_frame({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    EXPECT_NEAR(std::abs(frame.axes(0, 0)), std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(frame.third_moments[0], 0, 1e-15);
    EXPECT_NEAR(frame.third_moments[1], 1 / (135 * std::pow(2, 1.5)), 1e-15);
    EXPECT_LT(frame.axes(0, 1), 0); // towards the long tail: the corner at the origin
}

TEST(Moments, SolidMomentsOfTheUnitTetrahedron)
{
    // Barycentric coordinates of a uniform point are Dirichlet(1,1,1,1): variance 3/80, third central moment 6/960.
    Surface s{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    const Frame frame = principal_frame(s);
    EXPECT_NEAR(frame.measure, 1.0 / 6, 1e-15);
    EXPECT_LT((frame.centre - Point::Constant(0.25)).norm(), 1e-15);
    EXPECT_NEAR(frame.variances.sum(), 9.0 / 80, 1e-14);
    // Along (1,1,1)/sqrt 3 the sum of three is 1 minus the fourth: variance 3/80/3, the other two axes 3/80 + 1/80.
    EXPECT_LT((frame.variances - Point(1.0 / 20, 1.0 / 20, 1.0 / 80)).norm(), 1e-14);
    EXPECT_NEAR(std::abs(frame.third_moments[2]), 6.0 / 960 / std::pow(3.0, 1.5), 1e-15);
}

TEST(Moments, FrameFollowsTheBody)
{
    const Surface cover = tetrahedron();
    const Frame before = principal_frame(cover);
    const Eigen::Matrix3d rotation =
        (Eigen::AngleAxisd(1.1, Point::UnitX()) * Eigen::AngleAxisd(-2.3, Point(1, 2, 3).normalized())).matrix();
    const Frame after = principal_frame(moved(cover, 2.5, rotation, {100, -200, 300}));
    EXPECT_LT((after.centre - (2.5 * rotation * before.centre + Point(100, -200, 300))).norm(), 1e-10);
    EXPECT_LT((after.axes - rotation * before.axes).norm(), 1e-10);
    EXPECT_LT((after.variances - 6.25 * before.variances).norm(), 1e-10);
    EXPECT_LT((after.third_moments - 15.625 * before.third_moments).norm(), 1e-10);
}

TEST(Moments, InsideOutIsTheSameBody)
{
    Surface s = tetrahedron();
    const Frame outside = principal_frame(s);
    turn_inside_out(s);
    const Frame inside = principal_frame(s);
    EXPECT_EQ(inside.measure, -outside.measure);
    EXPECT_LT((inside.centre - outside.centre).norm(), 1e-14);
    EXPECT_LT((inside.axes - outside.axes).norm(), 1e-12);
    EXPECT_LT((inside.third_moments - outside.third_moments).norm(), 1e-14);
}

TEST(Moments, AxesAreRightHandedAndSigned)
{
    const Frame frame = principal_frame(tetrahedron());
    EXPECT_NEAR(frame.axes.determinant(), 1, 1e-12);
    EXPECT_GT(frame.third_moments[0], 0);
    EXPECT_GT(frame.third_moments[1], 0);
    EXPECT_GE(frame.variances[0], frame.variances[1]);
    EXPECT_GE(frame.variances[1], frame.variances[2]);
}

TEST(Moments, ClosedMeansEveryEdgeBalances)
{
    Surface s = tetrahedron();
    EXPECT_TRUE(is_closed_and_oriented(s));
    std::swap(s.triangles[1][0], s.triangles[1][1]); // one face turned
    EXPECT_FALSE(is_closed_and_oriented(s));
    s = tetrahedron();
    s.triangles.pop_back();
    EXPECT_FALSE(is_closed_and_oriented(s));
    EXPECT_FALSE(is_closed_and_oriented({}));
}

TEST(Moments, NothingEnclosedTakesTheSurface)
{
    // A triangle and its back: closed, with volume 0.
    const Frame frame = principal_frame({{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}});
    EXPECT_FALSE(frame.from_volume);
    EXPECT_NEAR(frame.measure, 2, 1e-12);
}

TEST(Moments, VolumeDoesNotDependOnThePoint)
{
    EXPECT_NEAR(signed_volume(box(3, 2, 1)), 6, 1e-12);
    EXPECT_NEAR(signed_volume(box(3, 2, 1), {7, -5, 11}), 6, 1e-12);
}

TEST(Moments, AFlippedFrameIsThatOfTheTurnedBody)
{
    Surface body = shapes::sphere(2);
    for (Point& p : body.points)
        p = Point(3, 2, 1).cwiseProduct(p + 0.1 * p.cwiseProduct(p));
    const Frame frame = solid_frame(body.points, body.triangles);
    for (const AxisFlips flips : axis_flips) {
        const Frame other = flipped(frame, flips);
        EXPECT_NEAR(other.axes.determinant(), 1, 1e-12) << name(flips);
        EXPECT_EQ(other.axes.col(0).dot(frame.axes.col(0)) < 0, flips.first);
        EXPECT_EQ(other.axes.col(1).dot(frame.axes.col(1)) < 0, flips.second);
        EXPECT_TRUE(turned_like(other, frame).axes.isApprox(frame.axes, 1e-12));
        for (int axis = 0; axis < 3; ++axis) { // third moments change sign with their axis
            double third = 0;
            for (const Point& p : body.points)
                third += std::pow(other.axes.col(axis).dot(p - frame.centre), 3);
            EXPECT_GT(third * other.third_moments[axis], 0) << name(flips) << axis;
        }
        EXPECT_EQ(may_be_flipped(frame, flips), !flips.first && !flips.second);
    }
}

} // namespace
