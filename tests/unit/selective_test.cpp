// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/placement/radial.h"
#include "vcg_ext/placement/selective.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

const Point origin(0, 0, 0);

// The plane z = 3 above the centre: its nearest point in the triangle is (0, 0, 3), its farthest a corner.
const std::array<Point, 3> face = {Point(4, 0, 3), Point(-4, 1, 3), Point(-4, -1, 3)};

TEST(SelectiveCandidate, TowardsTheNearestPoint)
{
    const Point w = selective_candidate(face[0], face, origin, 4); // |P| = 3 < 4 < |V| = 5
    EXPECT_NEAR(w.norm(), 4, 1e-14);
    EXPECT_NEAR(w.z(), 3, 1e-14); // inside the face
    EXPECT_NEAR(w.x(), std::sqrt(7.0), 1e-14);
    EXPECT_NEAR(w.y(), 0, 1e-14);
}

TEST(SelectiveCandidate, TowardsTheFarthestPoint)
{
    const double norm = 5.05; // |V| = 5 < norm < |Q| = sqrt(26)
    const Point w = selective_candidate(face[0], face, origin, norm);
    EXPECT_NEAR(w.norm(), norm, 1e-14);
    EXPECT_NEAR(w.z(), 3, 1e-13);
    const Point direction = (w - face[0]).normalized();
    EXPECT_NEAR(std::abs(direction.dot((face[1] - face[0]).normalized())), 1, 1e-10);
}

TEST(SelectiveCandidate, BelowTheNearestPoint)
{
    const Point w = selective_candidate(face[0], face, origin, 2);
    EXPECT_LT((w - Point(0, 0, 2)).norm(), 1e-14);
}

TEST(SelectiveCandidate, BeyondTheFarthestPoint)
{
    const Point w = selective_candidate(face[0], face, origin, 6);
    EXPECT_LT((w - face[1].normalized() * 6).norm(), 1e-14);
}

/// A fan about `top` over a square of half-width 1 at height 3; the centre is the origin.
Surface fan(const Point& top)
{
    return {{top, {1, 1, 3}, {-1, 1, 3}, {-1, -1, 3}, {1, -1, 3}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
}

TEST(PlaceSelective, SlidesInAFlatFan)
{
    const Surface surface = fan({0.3, 0.2, 3});
    const Cover cover(surface);
    const double norm = surface.points[0].norm() + 0.02;
    const Point w = place_selective(cover, 0, origin, norm);
    EXPECT_NEAR(w.norm(), norm, 1e-14);
    EXPECT_NEAR(w.z(), 3, 1e-13); // no quadric error at all
}

TEST(PlaceSelective, TakesChosPointWhereEveryCandidateFolds)
{
    // Far inwards each candidate turns a face over.
    const Surface surface = fan({0.3, 0.2, 3});
    const Cover cover(surface);
    const Point w = place_selective(cover, 0, origin, 0.5);
    EXPECT_LT((w - radial_point(surface.points[0], origin, 0.5)).norm(), 1e-14);
}

} // namespace
