// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/geometry/parts.h"

#include "support/shapes.h"
#include "vcg_ext/base/parallel.h"
#include "vcg_ext/geometry/sets.h"

#include <gtest/gtest.h>
#include <random>

using namespace vcg_ext;

namespace {

void add(Surface& all, const Surface& more)
{
    const int before = static_cast<int>(all.points.size());
    all.points.insert(all.points.end(), more.points.begin(), more.points.end());
    for (const Triangle& t : more.triangles)
        all.triangles.push_back({t[0] + before, t[1] + before, t[2] + before});
}

} // namespace

TEST(Pieces, AreSetsJoinedInTurnAtAnyNumberOfThreads)
{
    constexpr int vertices = 40000;
    std::mt19937 draws(3);
    const auto vertex = [&draws] { return static_cast<int>(draws() % vertices); };
    for (const int faces : {5000, 15000, 60000}) { // many pieces, one that holds half, nearly all one
        Surface surface;
        surface.points.resize(vertices, Point::Zero());
        Sets sets(vertices);
        for (int f = 0; f < faces; ++f) {
            const Triangle t = {vertex(), vertex(), vertex()};
            surface.triangles.push_back(t);
            sets.join(t[0], t[1]);
            sets.join(t[0], t[2]);
        }
        std::vector<int> expected(vertices);
        for (int v = 0; v < vertices; ++v)
            expected[v] = sets.of(v);
        for (const int threads : {1, 2, 5}) {
            set_threads(threads);
            EXPECT_EQ(pieces_of(surface), expected) << faces << " faces, " << threads << " threads";
        }
        set_threads(0);
    }
}

TEST(Parts, AreSortedByAreaAndWhole)
{
    Surface all;
    add(all, shapes::box(1, 1, 1));                                                   // area 6
    add(all, shapes::moved(shapes::box(1, 2, 3), 1, 0, Point(0, 0, 1), {9, 0, 0}));   // 22
    add(all, shapes::moved(shapes::box(1, 1, 1), 0.1, 0, Point(0, 0, 1), {0, 9, 0})); // .06
    const std::vector<Part> parts = connected_parts(all, 16, 0);
    ASSERT_EQ(parts.size(), 3U);
    EXPECT_NEAR(parts[0].area_share, 22 / 28.06, 1e-12);
    EXPECT_NEAR(parts[1].area_share, 6 / 28.06, 1e-12);
    for (const Part& part : parts) {
        EXPECT_EQ(part.surface.points.size(), 8U);
        EXPECT_EQ(part.surface.triangles.size(), 12U);
    }
    EXPECT_EQ(parts[1].surface.points, shapes::box(1, 1, 1).points);
    EXPECT_EQ(parts[1].surface.triangles, shapes::box(1, 1, 1).triangles);
    EXPECT_EQ(connected_parts(all, 16, 0.01).size(), 2U);
    EXPECT_EQ(connected_parts(all, 1, 0).size(), 1U);
}

TEST(Parts, OneBodyIsOnePart)
{
    const Surface sphere = shapes::sphere(3);
    const std::vector<Part> parts = connected_parts(sphere, 16, 0.01);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].surface.points, sphere.points);
    EXPECT_NEAR(parts[0].area_share, 1, 1e-12);
}
