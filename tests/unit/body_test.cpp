// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/load.h"
#include "support/shapes.h"
#include "support/topology.h"
#include "vcg_ext/carrier/statistic.h"
#include "vcg_ext/geometry/body.h"
#include "vcg_ext/geometry/boundary.h"
#include "vcg_ext/geometry/solid.h"
#include "vcg_ext/watermark/watermark.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

/// `surface`, the faces on one side of a plane moved off by `gap` of the diagonal: a seam all round.
Surface split(const Surface& surface, double gap)
{
    Surface torn = soup(surface);
    const Point step = gap * bounding_diagonal(surface) * Point(0.6, 0, 0.8);
    const Point middle = bounding_box(surface).center();
    for (const Triangle& t : torn.triangles)
        if (torn.points[t[0]].x() + torn.points[t[1]].x() + torn.points[t[2]].x() > 3 * middle.x())
            for (const int v : t)
                torn.points[v] += step;
    return torn;
}

/// `surface` and `count` triangles of some hundredth of its size about it.
Surface with_loose(Surface surface, int count)
{
    const double size = bounding_diagonal(surface);
    const Point middle = bounding_box(surface).center();
    for (int i = 0; i < count; ++i) {
        const int first = static_cast<int>(surface.points.size());
        const Point at = middle + size * Point(std::cos(i), std::sin(i), std::cos(3 * i));
        for (const Point& corner : {Point(0, 0, 0), Point(0.01, 0, 0), Point(0, 0.01, 0.01)})
            surface.points.push_back(at + size * corner);
        surface.triangles.push_back({first, first + 1, first + 2});
    }
    return surface;
}

void expect_same(const Body& a, const Body& b)
{
    EXPECT_EQ(a.surface.points, b.surface.points);
    EXPECT_EQ(a.surface.triangles, b.surface.triangles);
    EXPECT_EQ(a.site_of_vertex, b.site_of_vertex);
    EXPECT_EQ(a.pieces, b.pieces);
    EXPECT_EQ(a.closed, b.closed);
}

TEST(SitesMoved, AreThoseOfTheMovedSurfaceWhereFacesTellAll)
{
    const Surface whole = load("fandisk.off");
    for (const Surface& surface : {whole, soup(whole)}) {
        Surface moved = surface;
        for (Point& p : moved.points)
            p += 1e-3 * Point(std::sin(9 * p.y()), std::sin(9 * p.z()), std::sin(9 * p.x()));
        const Body before = body_of(surface);
        std::optional<Points> sites = sites_moved(before, moved.points);
        ASSERT_TRUE(sites);
        Body body = before;
        body.surface.points = std::move(*sites);
        expect_same(body, body_of(moved));
        moved.points[0] = moved.points[moved.triangles.back()[0]]; // where another is
        EXPECT_FALSE(sites_moved(before, moved.points));
    }
    Surface seam = soup(whole);
    const Body before = body_of(seam);
    seam.points[0] *= 1.1; // and away from its own
    EXPECT_FALSE(sites_moved(before, seam.points));
}

TEST(SitesMoved, AreEmptyForOpenSurfacesAndSeveralPieces)
{
    Surface open = load("fandisk.off");
    open.triangles.pop_back();
    EXPECT_FALSE(sites_moved(body_of(open), open.points));
    const Surface two = with_loose(load("fandisk.off"), 1);
    EXPECT_FALSE(sites_moved(body_of(two), two.points));
}

TEST(Body, SeamsAreClosedAndStayAsWideAsTheyWere)
{
    const Surface whole = load("fandisk.off");
    for (const double gap : {1e-7, 1e-5, 1e-4}) {
        const Surface torn = split(whole, gap);
        const Body body = body_of(torn);
        EXPECT_EQ(body.surface.points.size(), whole.points.size());
        EXPECT_TRUE(is_closed_and_oriented(body.surface));
        EXPECT_EQ(body.pieces, 1);
        Points moved = body.surface.points;
        for (Point& p : moved)
            p = 2 * p + Point(1, 2, 3);
        const Points points = with_sites_at(body, torn.points, moved);
        const double wide = bounding_diagonal(whole);
        for (std::size_t v = 0; v < points.size(); ++v) {
            const int site = body.site_of_vertex[v];
            const Point off = torn.points[v] - body.surface.points[site];
            EXPECT_LT((points[v] - moved[site] - off).norm(), 1e-14 * wide);
        }
    }
}

TEST(Body, WhatLiesApartIsNotSewn)
{
    const Surface sheet = shapes::triangular_grid(1, 1, 0.1);
    const Surface above = shapes::moved(sheet, 1, 0, {1, 0, 0}, {0, 0, 2e-3});
    EXPECT_EQ(body_of(joined(sheet, above)).surface.points.size(), 2 * sheet.points.size());
    // Edges that are shorter than any seam is wide are no seams.
    const Surface fine = shapes::triangular_grid(1, 0.002, 2e-4);
    EXPECT_EQ(body_of(fine).surface.points.size(), fine.points.size());
}

TEST(Body, LoosePiecesAreLeftOut)
{
    const Surface whole = load("fandisk.off");
    const Surface littered = with_loose(whole, 30);
    const Body body = body_of(littered);
    EXPECT_EQ(body.pieces, 31);
    EXPECT_EQ(body.loose_pieces, 30);
    EXPECT_EQ(body.surface.points, body_of(whole).surface.points);
    EXPECT_EQ(body.site_of_vertex.back(), -1);
    EXPECT_NE(about_loose_pieces(body).find("30 of the 31"), std::string::npos);
    EXPECT_EQ(with_sites_at(body, littered.points, Points(body.surface.points.size(), Point::Zero())).back(),
              littered.points.back());
}

TEST(Body, PiecesThatAreAllSmallAreTheBody)
{
    Surface heap;
    for (int i = 0; i < 150; ++i)
        heap = joined(heap, shapes::moved(shapes::box(1, 1, 1), 1, 0, {1, 0, 0}, {2.0 * i, 0, 0}));
    const Body body = body_of(heap);
    EXPECT_EQ(body.pieces, 150);
    EXPECT_EQ(body.loose_pieces, 0);
    EXPECT_EQ(body.surface.points.size(), heap.points.size());
}

TEST(Body, NeighboursRunRoundAlike)
{
    const Surface whole = load("fandisk.off");
    Surface turned = whole;
    for (std::size_t f = 0; f < turned.triangles.size() / 3; ++f)
        std::swap(turned.triangles[f][0], turned.triangles[f][1]);
    const Body body = body_of(turned);
    EXPECT_TRUE(is_closed_and_oriented(body.surface));
    EXPECT_NEAR(signed_volume(body.surface), signed_volume(whole), 1e-9 * std::abs(signed_volume(whole)));
}

TEST(PrincipalFrame, OfASheetOfHillsAndValleysIsThatOfItsArea)
{
    // Closed by a fan it bounds as much below as above: its volume nearly cancels.
    Surface sheet = shapes::triangular_grid(3, 1, 0.02);
    for (Point& p : sheet.points)
        p.z() = 0.05 * std::sin(9 * p.x()) * std::sin(11 * p.y());
    const Frame frame = principal_frame(sheet);
    EXPECT_FALSE(frame.from_volume);
    EXPECT_NEAR(frame.variances[0], 9.0 / 12, 0.05);
}

class Marks : public testing::TestWithParam<Method> {
protected:
    /// Whether the mark of `marked` is still in `other`.
    [[nodiscard]] DetectReport read(const Surface& other) const
    {
        return detect(other, key_, {carriers(), {message_}});
    }

    Surface marked(Surface surface) const
    {
        EmbedOptions options;
        options.carriers = carriers();
        options.message = message_;
        embed(surface, key_, options);
        return surface;
    }

private:
    [[nodiscard]] CarrierOptions carriers() const
    {
        CarrierOptions options;
        options.method = GetParam();
        options.bits = 64;
        return options;
    }

    Key key_ = Key("body_test");
    Message message_ = read_message("id:17");
};

TEST_P(Marks, BearWhatHappensToSingleTriangles)
{
    const Surface stego = marked(load("homer.off"));
    Surface other = split(stego, 1e-5);
    const std::size_t count = other.triangles.size();
    std::swap(other.triangles[count / 2][0], other.triangles[count / 2][1]);
    other.triangles.push_back(other.triangles[count / 3]);
    other.triangles.erase(other.triangles.begin() + static_cast<std::ptrdiff_t>(count / 5));
    const DetectReport found = read(with_loose(other, 30));
    EXPECT_TRUE(*found.present);
    EXPECT_GE(*found.detection_ratio, 0.98);
    EXPECT_EQ(found.loose_pieces, 30);
}

/// Waves feels the volume between one filling and another.
class MarksButWaves : public Marks {};

TEST_P(MarksButWaves, BearHolesBeingFilled)
{
    Surface open = load("homer.off");
    const Eigen::AlignedBox3d box = bounding_box(open);
    const double level = box.min().y() + 0.93 * box.sizes().y(); // the top of the head
    const auto above = [&](const Triangle& t) {
        return std::all_of(t.begin(), t.end(), [&](int v) { return open.points[v].y() > level; });
    };
    open.triangles.erase(std::remove_if(open.triangles.begin(), open.triangles.end(), above), open.triangles.end());
    const Surface stego = marked(open);
    EXPECT_TRUE(*read(stego).present);

    // All about one corner of the rim, as no tool and no fan of ours would do it.
    Surface filled = stego;
    const std::vector<EdgeUse> rim = boundary(stego);
    ASSERT_GT(rim.size(), 20);
    for (const EdgeUse& e : rim)
        if (e.low != rim[0].low && e.high != rim[0].low)
            filled.triangles.push_back(e.balance > 0 ? Triangle{e.high, e.low, rim[0].low}
                                                     : Triangle{e.low, e.high, rim[0].low});
    ASSERT_TRUE(is_closed_and_oriented(filled));
    EXPECT_TRUE(*read(filled).present);
}

std::string label(const testing::TestParamInfo<Method>& info)
{
    std::string text = name(info.param);
    text.erase(std::remove(text.begin(), text.end(), '-'), text.end());
    return text;
}

INSTANTIATE_TEST_SUITE_P(Body, Marks, testing::Values(Method::Waves, Method::LM, Method::Geodesic, Method::Spectral),
                         label);
INSTANTIATE_TEST_SUITE_P(Body, MarksButWaves, testing::Values(Method::LM, Method::Geodesic, Method::Spectral), label);

} // namespace
