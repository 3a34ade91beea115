// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/geometry/fans.h"

#include "support/load.h"
#include "support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace vcg_ext;

namespace {

/// The faces that the fans stand for, sorted, each beginning with its lowest vertex; each is met at its three corners.
std::vector<Triangle> faces_of(const Fans& fans)
{
    std::vector<Triangle> faces;
    for (int v = 0; v < fans.vertices(); ++v)
        for (const int* w = fans.begin(v); w != fans.end(v); ++w)
            if (w + 1 != fans.end(v) && *w != Fans::gap && w[1] != Fans::gap) {
                Triangle t{v, w[0], w[1]};
                std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
                faces.push_back(t);
            }
    std::sort(faces.begin(), faces.end());
    return faces;
}

Fans fans(const Surface& s)
{
    return fans_of(vertex_faces(static_cast<int>(s.points.size()), s.triangles), s.triangles);
}

void expect_all_faces(const Surface& s)
{
    std::vector<Triangle> thrice;
    for (Triangle t : s.triangles) {
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        thrice.insert(thrice.end(), 3, t);
    }
    std::sort(thrice.begin(), thrice.end());
    EXPECT_EQ(faces_of(fans(s)), thrice);
}

TEST(Fans, HoldEachFaceOnceAtEachCorner)
{
    expect_all_faces(load("elephant.off"));
    expect_all_faces(shapes::triangular_grid(2, 2, 0.1));
    Surface broken = load("fandisk.off"); // faces turned round, doubled and missing
    for (std::size_t f = 0; f < broken.triangles.size(); f += 7)
        std::swap(broken.triangles[f][0], broken.triangles[f][1]);
    for (std::size_t f = 0; f < 1000; f += 3)
        broken.triangles.push_back(broken.triangles[f]);
    broken.triangles.erase(broken.triangles.begin() + 2000, broken.triangles.begin() + 2100);
    expect_all_faces(broken);
}

TEST(Fans, OfAClosedSurfaceAreOneThatEndsWhereItBegins)
{
    const Surface s = shapes::sphere(3);
    const Fans all = fans(s);
    for (int v = 0; v < all.vertices(); ++v) {
        EXPECT_EQ(*all.begin(v), all.end(v)[-1]);
        EXPECT_EQ(std::count(all.begin(v), all.end(v), Fans::gap), 0);
    }
}

TEST(Fans, OfManyFacesTakeNotTheirSquare)
{
    constexpr int count = 200000; // a cone
    Surface s;
    s.points.emplace_back(0, 0, 1);
    for (int i = 0; i < count; ++i) {
        const double turn = 2 * std::acos(-1.0) * i / count;
        s.points.emplace_back(std::cos(turn), std::sin(turn), 0);
        s.triangles.push_back({0, 1 + i, 1 + (i + 1) % count});
    }
    expect_all_faces(s);
}

} // namespace
