// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/base/pi.h"
#include "vcg_ext/metric/bend.h"

#include "support/shapes.h"
#include "vcg_ext/geometry/normals.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

constexpr double degree = pi / 180;

double bend(const Surface& before, const Surface& after)
{
    const VertexFaces around = vertex_faces(static_cast<int>(before.points.size()), before.triangles);
    return largest_bend(face_normals(before.points, before.triangles), after.points, before.triangles, around);
}

TEST(Bend, OfASquareIsTheAngleOfItsFold)
{
    const Surface flat{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    EXPECT_EQ(bend(flat, flat), 0);
    for (const double angle : {0.01, 1.0, 30.0, 120.0}) { // about the diagonal
        Surface folded = flat;
        const Point middle(0.5, 0.5, 0);
        const Point out = Point(0.5, -0.5, 0);
        folded.points[1] = middle + std::cos(angle * degree) * out + Point(0, 0, std::sin(angle * degree) * out.norm());
        EXPECT_NEAR(bend(flat, folded), angle, 1e-6);
    }
}

TEST(Bend, LooksAtPlanesAlone)
{
    const Surface box = shapes::box(3, 2, 1);
    Surface longer = box;
    for (Point& p : longer.points)
        p.z() *= 1.5;
    EXPECT_NEAR(bend(box, longer), 0, 1e-6);
    const Surface sphere = shapes::sphere(3);
    Surface wild = sphere;
    wild.points[0] *= 1.2;
    EXPECT_EQ(bend(sphere, wild), 0);
}

} // namespace
