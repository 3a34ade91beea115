// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/geometry/normals.h"
#include "vcg_ext/geometry/size.h"

#include "support/shapes.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

TEST(Size, OfABox)
{
    const Surface box = shapes::box(1, 2, 3);
    EXPECT_DOUBLE_EQ(surface_area(box), 22);
    double sum = 0;
    for (const double doubled : doubled_areas(box.points, box.triangles))
        sum += doubled / 2;
    EXPECT_DOUBLE_EQ(sum, 22);
    // Each of the six sides has its four edges, and its diagonal twice.
    const double edges = 8 * (1 + 2 + 3) + 4 * (std::sqrt(5.0) + std::sqrt(10.0) + std::sqrt(13.0));
    EXPECT_DOUBLE_EQ(mean_edge_length(box), edges / 36);
    EXPECT_EQ(mean_edge_length({}), 0);
    EXPECT_EQ(surface_area({}), 0);
}

TEST(Normals, OfASpherePointOut)
{
    const Surface ball = shapes::sphere(4);
    const Points at_vertices = vertex_normals(ball.points, ball.triangles);
    for (std::size_t v = 0; v < ball.points.size(); ++v)
        EXPECT_LT((at_vertices[v] - ball.points[v]).norm(), 0.02);
    const Points of_faces = face_normals(ball.points, ball.triangles);
    for (std::size_t f = 0; f < ball.triangles.size(); ++f) {
        EXPECT_NEAR(of_faces[f].norm(), 1, 1e-12);
        EXPECT_GT(of_faces[f].dot(ball.points[ball.triangles[f][0]]), 0.99);
    }
}

TEST(Normals, AreNoneWithoutAnArea)
{
    const Surface line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
    EXPECT_EQ(face_normals(line.points, line.triangles)[0], Point(0, 0, 0));
    EXPECT_EQ(vertex_normals(line.points, line.triangles)[1], Point(0, 0, 0));
}

} // namespace
