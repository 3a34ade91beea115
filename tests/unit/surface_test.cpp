// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/load.h"
#include "support/topology.h"
#include "vcg_ext/base/mesh.h"
#include "vcg_ext/base/parallel.h"
#include "vcg_ext/base/surface.h"
#include "vcg_ext/base/weld.h"

#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <set>

using namespace vcg_ext;

namespace {

TEST(Weld, BringsASoupBackToTheSolid)
{
    const Surface fandisk = load("fandisk.off");
    const Surface torn = soup(fandisk);
    const Welded welded = weld(torn);
    EXPECT_EQ(welded.surface.points.size(), fandisk.points.size());
    ASSERT_EQ(welded.surface.triangles.size(), fandisk.triangles.size());
    for (std::size_t f = 0; f < fandisk.triangles.size(); ++f)
        for (int k = 0; k < 3; ++k)
            EXPECT_EQ(welded.surface.points[welded.surface.triangles[f][k]], fandisk.points[fandisk.triangles[f][k]]);
    // Closed: every directed edge has its opposite.
    std::set<std::pair<int, int>> edges;
    for (const Triangle& t : welded.surface.triangles)
        for (int k = 0; k < 3; ++k)
            edges.insert({t[k], t[(k + 1) % 3]});
    for (const auto& [a, b] : edges)
        EXPECT_TRUE(edges.count({b, a}));
}

TEST(Weld, LeavesOutWhatNoFaceNeeds)
{
    const Surface surface{{{0, 0, 0}, {1, 0, 0}, {-0.0, 0, 0}, {0, 1, 0}, {5, 5, 5}},
                          {{0, 1, 3}, {0, 1, 2}, {2, 1, 3}}};
    const Welded welded = weld(surface);
    EXPECT_EQ(welded.site_of_vertex, (std::vector<int>{0, 1, 0, 2, -1}));
    EXPECT_EQ(welded.surface.points.size(), 3u);
    EXPECT_EQ(welded.surface.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}}));
}

TEST(RoundedToFloat, IsAFloatEverywhere)
{
    for (const int count : {1, 2, 3, 4, 5, 7, 4097, 8190}) { // compilers treat the last few by themselves
        Points points;
        for (int i = 0; i < count; ++i)
            points.emplace_back(std::sin(i), std::cos(i) / 3, 0.1 * i);
        const Points rounded = rounded_to_float(points);
        for (int i = 0; i < count; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                const volatile float nearest = static_cast<float>(points[i][axis]);
                EXPECT_EQ(rounded[i][axis], static_cast<double>(nearest)) << i << " of " << count;
            }
    }
}

TEST(FirstEquals, IsTheFirstByAMapWithAnyNumberOfThreads)
{
    Points points;
    for (int i = 0; i < 50000; ++i) {
        const int place = i * 7919 % 20011; // each some two or three times; half of the zeros negative
        points.emplace_back(place % 29 * 0.1, place % 2 ? 0.0 : -0.0, place / 29 / 3.0);
    }
    std::map<std::array<double, 3>, int> places;
    std::vector<int> expected;
    for (const Point& p : points)
        expected.push_back(places.insert({{p[0], p[1] + 0.0, p[2]}, static_cast<int>(expected.size())}).first->second);
    for (const int threads : {1, 4}) {
        set_threads(threads);
        EXPECT_EQ(first_equals(points), expected);
    }
    set_threads(0);
    EXPECT_FALSE(is_identity(expected));
    EXPECT_TRUE(first_equals({}).empty());
}

TEST(Unweld, MovesVerticesAtOnePositionTogether)
{
    const Surface torn = soup(load("cube.off"));
    const Welded welded = weld(torn);
    Points moved = welded.surface.points;
    for (Point& p : moved)
        p *= 1.01;
    const Points points = unweld(torn.points, welded.site_of_vertex, moved);
    for (std::size_t v = 0; v < points.size(); ++v)
        EXPECT_EQ(points[v], torn.points[v] * 1.01);
}

TEST(VertexFaces, ListsEveryCornerOnceInOrder)
{
    const Surface surface = load("fandisk.off");
    const VertexFaces around = vertex_faces(static_cast<int>(surface.points.size()), surface.triangles);
    std::size_t corners = 0;
    for (int v = 0; v < static_cast<int>(surface.points.size()); ++v) {
        EXPECT_TRUE(std::is_sorted(around.begin(v), around.end(v)));
        for (const int* f = around.begin(v); f != around.end(v); ++f) {
            const Triangle& t = surface.triangles[*f];
            EXPECT_TRUE(t[0] == v || t[1] == v || t[2] == v);
            ++corners;
        }
    }
    EXPECT_EQ(corners, 3 * surface.triangles.size());
}

TEST(Mesh, HoldsTheSurfaceInTheSameOrder)
{
    const Surface surface = load("bunny00.off");
    Mesh mesh;
    to_mesh(surface, mesh);
    const Surface back = to_surface(mesh);
    EXPECT_EQ(back.points, surface.points);
    EXPECT_EQ(back.triangles, surface.triangles);
}

} // namespace
