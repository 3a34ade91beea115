// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/load.h"
#include "support/shapes.h"
#include "support/topology.h"
#include "vcg_ext/base/pi.h"
#include "vcg_ext/geometry/body.h"
#include "vcg_ext/geometry/solid.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace {

using namespace vcg_ext;

Frame frame_of(const Surface& surface)
{
    const Surface mended = body_of(surface).surface;
    const SolidTopology topology = solid_topology(mended);
    return solid_frame(solid_points(topology, mended.points), topology.triangles);
}

/// How far the frames differ, in units of the body: positions by the radius, axes by their angle.
double difference(const Frame& a, const Frame& b)
{
    return std::max((a.centre - b.centre).norm() / ball_radius(a), (a.axes - b.axes).norm());
}

/// A body that has a frame: all variances and the third moments differ.
Surface body()
{
    Surface s = shapes::sphere(3);
    for (Point& p : s.points)
        p = Point((1.5 + 0.3 * p[1]) * p[0] + 0.2 * p[0] * p[0], p[1] + 0.1 * p[1] * p[1], 0.7 * p[2]);
    return s;
}

TEST(Solid, BoxHasItsTextbookMoments)
{
    const Frame frame = frame_of(shapes::box(3, 2, 1));
    EXPECT_NEAR(frame.measure, 6, 1e-12);
    EXPECT_LT((frame.centre - Point(1.5, 1, 0.5)).norm(), 1e-12);
    EXPECT_LT((frame.variances - Point(9, 4, 1) / 12).norm(), 1e-12);
    EXPECT_LT(frame.third_moments.norm(), 1e-12);
    EXPECT_NEAR(ball_radius(frame), std::cbrt(6 * 3 / (4 * pi)), 1e-12);
}

TEST(Solid, AgreesWithThePrincipalFrameOfAClosedSurface)
{
    const Surface closed = body();
    const Frame solid = frame_of(closed);
    const Frame principal = principal_frame(closed);
    EXPECT_NEAR(solid.measure, principal.measure, 1e-12);
    EXPECT_LT((solid.variances - principal.variances).norm(), 1e-12);
    EXPECT_LT((solid.third_moments - principal.third_moments).norm(), 1e-12);
    EXPECT_LT(difference(solid, principal), 1e-10);
}

TEST(Solid, TetrahedronHasDirichletsMoments)
{
    // Barycentric coordinates of a uniform point are Dirichlet(1,1,1,1): variance 3/80, third central moment 6/960.
    const Frame frame =
        frame_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}});
    EXPECT_NEAR(frame.measure, 1.0 / 6, 1e-15);
    EXPECT_LT((frame.variances - Point(1.0 / 20, 1.0 / 20, 1.0 / 80)).norm(), 1e-14);
    EXPECT_NEAR(std::abs(frame.third_moments[2]), 6.0 / 960 / std::pow(3.0, 1.5), 1e-15);
}

TEST(Solid, AMissingDoubledOrTurnedTriangleChangesNothing)
{
    const Surface whole = body();
    const Frame frame = frame_of(whole);
    for (const std::size_t f : {std::size_t(0), whole.triangles.size() / 2, whole.triangles.size() - 1}) {
        Surface missing = whole;
        missing.triangles.erase(missing.triangles.begin() + f);
        EXPECT_LT(difference(frame, frame_of(missing)), 1e-10);
        EXPECT_NEAR(frame_of(missing).measure, frame.measure, 1e-12);
        Surface doubled = whole;
        doubled.triangles.push_back(whole.triangles[f]);
        EXPECT_LT(difference(frame, frame_of(doubled)), 1e-10);
        Surface turned = whole;
        std::swap(turned.triangles[f][0], turned.triangles[f][1]);
        EXPECT_LT(difference(frame, frame_of(turned)), 1e-10);
        EXPECT_NEAR(frame_of(turned).measure, frame.measure, 1e-12);
    }
}

TEST(Solid, TheGreaterPartOfAComponentSaysWhichWayItRuns)
{
    const Surface whole = body();
    Surface turned = whole;
    for (std::size_t f = 0; f < turned.triangles.size() * 2 / 5; ++f)
        std::swap(turned.triangles[f][0], turned.triangles[f][1]);
    EXPECT_LT(difference(frame_of(whole), frame_of(turned)), 1e-10);
    EXPECT_NEAR(frame_of(turned).measure, frame_of(whole).measure, 1e-12);
}

TEST(Solid, AnInsideOutBodyHasTheSameFrame)
{
    const Surface whole = body();
    Surface turned = whole;
    for (Triangle& t : turned.triangles)
        std::swap(t[0], t[1]);
    EXPECT_LT(difference(frame_of(whole), frame_of(turned)), 1e-10);
    EXPECT_NEAR(frame_of(turned).measure, -frame_of(whole).measure, 1e-12);
}

TEST(Solid, OpenSeamsAreSewn)
{
    const Surface whole = body();
    const Frame frame = frame_of(whole);
    const double diagonal = bounding_diagonal(whole);
    for (const double gap : {1e-12, 1e-9, 1e-7, 1e-6, 0.9e-5, 1.1e-5}) {
        // The half with x > 0 moved off along x: a seam all round.
        Surface split = soup(whole);
        for (const Triangle& t : split.triangles)
            if (split.points[t[0]][0] + split.points[t[1]][0] + split.points[t[2]][0] > 0)
                for (const int v : t)
                    split.points[v][0] += gap * diagonal;
        EXPECT_LT(difference(frame, frame_of(split)), 5 * gap + 1e-9) << gap;
        // Each triangle by itself: only sewing can close that.
        if (gap < 0.5e-5) {
            Surface loose = soup(whole);
            for (std::size_t f = 0; f < loose.triangles.size(); ++f)
                for (const int v : loose.triangles[f])
                    loose.points[v][f % 3] += 0.5 * gap * diagonal * (f % 2 ? 1 : -1);
            EXPECT_LT(difference(frame, frame_of(loose)), 5 * gap + 1e-9) << gap;
        }
    }
}

TEST(Solid, AFlatHoleClosedByItsFanIsTheWholeSolid)
{
    // A sphere cut flat at z = .6: volume pi (2 / 3 + .6 - .072), centroid by the moment -(1 - .36)^2 pi / 4.
    Surface cap{{}, {}};
    const int rings = 200;
    const int around = 256;
    const double top = std::acos(0.6);
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < around; ++j) {
            const double polar = top + (pi - top) * i / rings;
            cap.points.emplace_back(std::sin(polar) * std::cos(2 * pi * j / around),
                                    std::sin(polar) * std::sin(2 * pi * j / around), std::cos(polar));
        }
    const int pole = static_cast<int>(cap.points.size());
    cap.points.emplace_back(0, 0, -1);
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < around; ++j) {
            const int a = i * around + j;
            const int b = i * around + (j + 1) % around;
            if (i + 1 == rings) {
                cap.triangles.push_back({a, pole, b});
            } else {
                cap.triangles.push_back({a, a + around, b});
                cap.triangles.push_back({b, a + around, b + around});
            }
        }
    const Frame frame = frame_of(cap);
    const double volume = pi * (2.0 / 3 + 0.6 - 0.072);
    EXPECT_NEAR(frame.measure, volume, 5e-4 * volume);
    EXPECT_NEAR(frame.centre[2], -0.64 * 0.64 * pi / 4 / volume, 2e-4);
}

TEST(Solid, FollowsTheBody)
{
    const Surface whole = body();
    const Frame frame = frame_of(whole);
    const Point axis = Point(1, 2, 2) / 3;
    const Frame moved = frame_of(shapes::renumbered(shapes::moved(whole, 3, 1.1, axis, {400, -300, 200}), 7));
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(1.1, axis).toRotationMatrix();
    EXPECT_LT((moved.centre - 3 * rotation * frame.centre - Point(400, -300, 200)).norm(), 1e-9);
    EXPECT_LT((moved.axes - rotation * frame.axes).norm(), 1e-9);
    EXPECT_NEAR(ball_radius(moved), 3 * ball_radius(frame), 1e-9);
}

TEST(Solid, AngularMomentTurnsWithTheBody)
{
    // A prism over an equilateral triangle has two equal variances; its third moment gives the angle.
    const double s = std::sqrt(3.0) / 2;
    const Surface prism{{{1, 0, 0}, {-0.5, s, 0}, {-0.5, -s, 0}, {1, 0, 3}, {-0.5, s, 3}, {-0.5, -s, 3}},
                        {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}}};
    Frame frame = frame_of(prism);
    EXPECT_NEAR(frame.variances[1], frame.variances[2], 1e-12);
    frame.axes << 0, 1, 0, 0, 0, 1, 1, 0, 0; // long axis z, then x and y
    const auto moment = angular_moment(prism.points, prism.triangles, frame, 1, 2, 3);
    EXPECT_GT(moment[0], 0);
    EXPECT_NEAR(moment[1], 0, 1e-12);
    EXPECT_NEAR(std::hypot(angular_moment(prism.points, prism.triangles, frame, 1, 2, 2)[0],
                           angular_moment(prism.points, prism.triangles, frame, 1, 2, 2)[1]),
                0, 1e-12);
    const Surface turned = shapes::moved(prism, 1, 0.3, Point(0, 0, 1), Point(0, 0, 0));
    const auto other = angular_moment(turned.points, turned.triangles, frame, 1, 2, 3);
    EXPECT_NEAR(std::atan2(other[1], other[0]), 0.9, 1e-9);
    // Mean of Re (x + iy)^3 = x^3 - 3 x y^2 over a triangle with corners at 1, w, w^2: h_3 / 10 = 1 / 10 of the cube.
    const double r = ball_radius(frame);
    EXPECT_NEAR(moment[0] * r * r * r, 0.1, 1e-12);
}

} // namespace
