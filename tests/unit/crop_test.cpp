// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/attack/crop.h"

#include "support/load.h"
#include "support/shapes.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

TEST(Crop, RemovesThePartItIsTold)
{
    const Surface disk = load("fandisk.off");
    for (const double part : {0.0, 0.05, 0.3, 0.5, 0.95})
        EXPECT_NEAR(static_cast<double>(crop(disk, part, 1).triangles.size()),
                    (1 - part) * static_cast<double>(disk.triangles.size()), 0.5);
}

TEST(Crop, CutsByAPlane)
{
    // Half of a sphere: what is left, and what is not, lie on two sides of a plane through the centre.
    const Surface ball = shapes::sphere(4);
    const Surface half = crop(ball, 0.5, 9);
    Point mean = Point::Zero();
    for (const Triangle& t : half.triangles)
        mean += (half.points[t[0]] + half.points[t[1]] + half.points[t[2]]) / 3;
    const Point normal = mean.normalized();
    for (const Triangle& t : half.triangles)
        EXPECT_GT(normal.dot(half.points[t[0]] + half.points[t[1]] + half.points[t[2]]) / 3, -0.1);
}

TEST(Crop, KeepsNoVertexWithoutAFace)
{
    const Surface rest = crop(load("fandisk.off"), 0.6, 2);
    std::vector<char> used(rest.points.size(), 0);
    for (const Triangle& t : rest.triangles)
        for (const int v : t)
            used[v] = 1;
    EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
}

} // namespace
