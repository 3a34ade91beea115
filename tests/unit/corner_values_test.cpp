// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/load.h"
#include "support/shapes.h"
#include "support/topology.h"
#include "vcg_ext/geometry/corner_values.h"
#include "vcg_ext/geometry/normals.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

/// Values that are a function of the position: of a corner too.
CornerValues values_of(const Surface& surface, int channels,
                       const std::function<double(int face, const Point&, int)>& at)
{
    CornerValues values;
    values.channels = channels;
    for (std::size_t f = 0; f < surface.triangles.size(); ++f)
        for (const int v : surface.triangles[f])
            for (int c = 0; c < channels; ++c)
                values.values.push_back(at(static_cast<int>(f), surface.points[v], c));
    return values;
}

/// Inner vertices shifted within the plane z = 0 by up to `most`, those on the border along it or not at all.
Points shifted(const Surface& sheet, double most)
{
    Points points = sheet.points;
    const Eigen::AlignedBox3d box = bounding_box(sheet);
    for (std::size_t v = 0; v < points.size(); ++v) {
        const Point& p = sheet.points[v];
        const double inside = std::min(std::min(p.x() - box.min().x(), box.max().x() - p.x()),
                                       std::min(p.y() - box.min().y(), box.max().y() - p.y()));
        if (inside > 2 * most)
            points[v] +=
                most * Point(std::sin(17.0 * static_cast<double>(v)), std::cos(29.0 * static_cast<double>(v)), 0);
    }
    return points;
}

TEST(CarriedValues, OnAPlaneAreThoseOfTheNewPlace)
{
    const Surface sheet = shapes::triangular_grid(2, 1, 0.05);
    const auto linear = [](int, const Point& p, int c) { return c == 0 ? 3 * p.x() + p.y() : p.x() - 2 * p.y(); };
    const Points moved = shifted(sheet, 0.09); // further than a face
    const CarriedValues carried = carried_values(sheet, values_of(sheet, 2, linear), moved);
    const CornerValues expected = values_of({moved, sheet.triangles}, 2, linear);
    for (std::size_t i = 0; i < expected.values.size(); ++i)
        EXPECT_NEAR(carried.values.values[i], expected.values[i], 1e-12);
    EXPECT_NEAR(carried.stretch, 1, 1e-9);
}

TEST(CarriedValues, StayToTheBitWhereNothingMoves)
{
    const Surface bunny = load("bunny00.off");
    const CornerValues values = values_of(bunny, 3, [](int, const Point& p, int c) { return std::sin(7 * p[c]); });
    const CarriedValues carried = carried_values(bunny, values, bunny.points);
    EXPECT_EQ(carried.values.values, values.values);
    EXPECT_EQ(carried.stretch, 1);
}

TEST(CarriedValues, SeamsShowOnePlaceFromBothSides)
{
    // Two charts that meet at x = 1; the one on the right shows 100 more. Vertices on the seam slide along it and off it.
    const Surface sheet = shapes::triangular_grid(2, 1, 0.05);
    Surface split = soup(sheet); // seams are told by positions, not by numbers
    const auto right = [&](int face) {
        const Triangle& t = split.triangles[face];
        return split.points[t[0]].x() + split.points[t[1]].x() + split.points[t[2]].x() > 3;
    };
    const CornerValues values = values_of(
        split, 2, [&](int face, const Point& p, int c) { return (c == 0 ? p.x() : p.y()) + (right(face) ? 100 : 0); });
    Points moved = split.points;
    for (Point& p : moved)
        p += 0.02 * Point(std::sin(50 * p.y()), std::cos(70 * p.x() + 30 * p.y()), 0);
    const CarriedValues carried = carried_values(split, values, moved);
    std::vector<std::array<double, 2>> shown[2]; // per side, of the vertices on the seam, in the order of positions
    int on_seam = 0;
    for (int f = 0; f < static_cast<int>(split.triangles.size()); ++f)
        for (int k = 0; k < 3; ++k) {
            const Point& p = split.points[split.triangles[f][k]];
            for (int g = 0; g < static_cast<int>(split.triangles.size()); ++g)
                for (int j = 0; j < 3; ++j)
                    if (split.points[split.triangles[g][j]] == p && right(f) != right(g)) {
                        ++on_seam;
                        for (int c = 0; c < 2; ++c)
                            EXPECT_NEAR(std::abs(carried.values.at(f, k)[c] - carried.values.at(g, j)[c]), 100, 1e-12);
                    }
        }
    EXPECT_GT(on_seam, 40);
}

TEST(OnSeams, IsWhereAPositionShowsTwoThings)
{
    // Two triangles of four vertices, and the second's corner that is there twice by another vertex.
    const Surface sheet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}, {{0, 1, 2}, {4, 3, 2}}};
    CornerValues values;
    values.channels = 1;
    values.values = {0, 1, 2, /* the second triangle's */ 1, 3, 2};
    EXPECT_EQ(on_seams(sheet, values), std::vector<char>(5, 0));
    values.values[3] = 1.5;
    EXPECT_EQ(on_seams(sheet, values), (std::vector<char>{0, 1, 0, 0, 1}));
}

TEST(CarriedValues, StretchIsTheSingularValueThatIsLeft)
{
    // Pulled out threefold along x: nothing can make up for that, and the factor is 3.
    const Surface sheet = shapes::triangular_grid(1, 1, 0.2);
    Points moved = sheet.points;
    const auto value = [](int, const Point& p, int) { return p.x(); };
    for (Point& p : moved)
        p = Point(p.x(), p.y(), 3 * p.x()); // lifted off: feet lie where the plane is nearest
    const double lifted = carried_values(sheet, values_of(sheet, 1, value), moved).stretch;
    EXPECT_NEAR(lifted, std::sqrt(10.0), 1e-9);
}

TEST(CarriedValues, SpheresTurnedInThemselvesKeepTheirPicture)
{
    const Surface ball = shapes::sphere(5);
    const auto height = [](int, const Point& p, int) { return p.z(); };
    Points moved = ball.points;
    for (Point& p : moved) { // along the meridians, by up to four faces
        const double polar = std::acos(p.z()) + 0.1 * std::sin(p.x() * 3) * std::sin(std::acos(p.z()));
        const double angle = std::atan2(p.y(), p.x());
        p = Point(std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar));
    }
    const CarriedValues carried = carried_values(ball, values_of(ball, 1, height), moved);
    const CornerValues expected = values_of({moved, ball.triangles}, 1, height);
    for (std::size_t i = 0; i < expected.values.size(); ++i)
        EXPECT_NEAR(carried.values.values[i], expected.values[i], 1e-3);
    EXPECT_LT(carried.stretch, 1.02);
}

} // namespace
