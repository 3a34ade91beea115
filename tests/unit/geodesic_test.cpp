// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/load.h"
#include "support/shapes.h"
#include "support/topology.h"
#include "vcg_ext/base/error.h"
#include "vcg_ext/carrier/statistic.h"
#include "vcg_ext/geometry/body.h"
#include "vcg_ext/geometry/solid.h"
#include "vcg_ext/watermark/watermark.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

const Key& test_key()
{
    static const Key key("geodesic_test");
    return key;
}

EmbedOptions options_for(Statistic statistic, int bits)
{
    EmbedOptions options;
    options.carriers.method = Method::Geodesic;
    options.carriers.statistic = statistic;
    options.carriers.bits = bits;
    options.carriers.trim = 0.1;
    options.message = read_message("bits:110000001111111111101110");
    return options;
}

DetectReport read(const Surface& surface, const EmbedOptions& embedded)
{
    DetectOptions options;
    options.carriers = embedded.carriers;
    options.expected = {embedded.message};
    return detect(surface, test_key(), options);
}

/// An ellipsoid with bumps, its third moments as large as it is uneven.
Surface bumpy(const Point& axes, double uneven)
{
    Surface s = shapes::sphere(5);
    for (Point& p : s.points)
        p = (1 + 0.02 * std::cos(9 * p.x()) * std::cos(7 * p.y())) *
            Point(p + uneven * p.cwiseProduct(p)).cwiseProduct(axes);
    return s;
}

TEST(Geodesic, WarnsWhereTheAxesAreNotSure)
{
    const EmbedOptions options = options_for(Statistic::Mean, 24);
    Surface round = bumpy({3, 2, 1.99}, 0.1);
    const EmbedReport embedded = embed(round, test_key(), options);
    const DetectReport found = read(round, options);
    EXPECT_EQ(*found.detection_ratio, 1);
    for (const std::vector<std::string>& warnings : {embedded.warnings, found.warnings}) {
        const auto says = [](const std::string& warning) { return warning.find("not sure") != std::string::npos; };
        EXPECT_EQ(std::count_if(warnings.begin(), warnings.end(), says), 1);
    }
    Surface clear = bumpy({3, 2, 1.2}, 0.1);
    EXPECT_TRUE(embed(clear, test_key(), options).warnings.empty());
}

TEST(Geodesic, AnEvenBodyIsReadWhicheverWayItLies)
{
    const EmbedOptions options = options_for(Statistic::Mean, 24);
    Surface marked = bumpy({3, 2, 1.2}, 0);
    (void)embed(marked, test_key(), options);
    std::vector<std::string> seen;
    for (int i = 0; i < 4; ++i) {
        // Third moments of a chosen sign, larger than those that the mark left.
        Surface pushed = marked;
        for (Point& p : pushed.points)
            p += Point((i & 1) ? 1e-4 : -1e-4, (i & 2) ? 1e-4 : -1e-4, 0).cwiseProduct(p).cwiseProduct(p);
        const DetectReport found = read(pushed, options);
        EXPECT_EQ(*found.detection_ratio, 1) << i;
        EXPECT_DOUBLE_EQ(*found.p_binomial, 4 * std::exp2(-24)) << i;
        seen.push_back(found.orientation);
    }
    std::sort(seen.begin(), seen.end());
    EXPECT_EQ(std::unique(seen.begin(), seen.end()) - seen.begin(), 4);
}

TEST(Geodesic, AHoleIsTheSameFilledOrNot)
{
    Surface s = shapes::sphere(5);
    for (Point& p : s.points)
        p = Point(1.7 * p.x() + 0.2 * p.y() * p.y(), 1.2 * p.y() + 0.1 * p.x() * p.x(), p.z());
    const auto in_cap = [&](const Triangle& t) { return s.points[t[0]].z() > 0.9; };
    s.triangles.erase(std::remove_if(s.triangles.begin(), s.triangles.end(), in_cap), s.triangles.end());
    const EmbedOptions options = options_for(Statistic::Mean, 24);
    embed(s, test_key(), options);
    EXPECT_EQ(*read(s, options).detection_ratio, 1);
    const Body body = body_of(s);
    const SolidTopology topology = solid_topology(body.surface);
    EXPECT_EQ(topology.apexes, 1);
    EXPECT_EQ(*read({solid_points(topology, body.surface.points), topology.triangles}, options).detection_ratio, 1);
}

/// A twisted band: one side, one border.
TEST(Geodesic, AMeshThatIsNotOrientableIsMarkedAndRead)
{
    constexpr int around = 300;
    constexpr int across = 20;
    Surface s;
    const double pi = std::acos(-1.0);
    for (int i = 0; i < around; ++i)
        for (int j = 0; j <= across; ++j) {
            const double u = 2 * pi * i / around;
            const double w = 0.6 * j / across - 0.3;
            const double radius = 1 + 0.2 * std::cos(u - 0.7) + w * std::cos(u / 2); // no symmetry: it has a frame
            s.points.emplace_back(1.3 * radius * std::cos(u), radius * std::sin(u), w * std::sin(u / 2));
        }
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j) {
            const bool last = i + 1 == around;
            const auto next = [&](int k) { return last ? across - k : (i + 1) * (across + 1) + k; };
            const int a = i * (across + 1) + j;
            s.triangles.push_back({a, next(j), next(j + 1)});
            s.triangles.push_back({a, next(j + 1), a + 1});
        }
    const EmbedOptions options = options_for(Statistic::Mean, 24);
    embed(s, test_key(), options);
    EXPECT_EQ(*read(s, options).detection_ratio, 1);
}

TEST(Geodesic, PartsThatTheFrontNeverReachesStayAsTheyAre)
{
    const Surface body = load("fandisk.off");
    const double size = bounding_diagonal(body);
    Point centre = Point::Zero();
    for (const Point& p : body.points)
        centre += p / static_cast<double>(body.points.size());
    // Inside the body, so that the farthest hit is on the body for every key.
    const Surface inner = shapes::moved(shapes::sphere(2), 0.03 * size, 0, {1, 0, 0}, centre);
    Surface s = joined(body, inner);
    const EmbedOptions options = options_for(Statistic::Mean, 24);
    const EmbedReport report = embed(s, test_key(), options);
    EXPECT_EQ(report.pieces, 2);
    EXPECT_EQ(report.loose_pieces, 0);
    ASSERT_EQ(report.warnings.size(), 2);
    EXPECT_NE(report.warnings[0].find(std::to_string(inner.points.size()) + " vertices"), std::string::npos);
    for (std::size_t v = body.points.size(); v < s.points.size(); ++v)
        EXPECT_EQ(s.points[v], inner.points[v - body.points.size()].cast<float>().cast<double>());
    EXPECT_EQ(*read(s, options).detection_ratio, 1);
}

TEST(Geodesic, EmptyStripsAreRefusedAndANumberThatFitsIsFound)
{
    Surface s = load("fandisk.off");
    const Points before = s.points;
    const EmbedOptions options = options_for(Statistic::Mean, 1024);
    try {
        embed(s, test_key(), options);
        FAIL();
    } catch (const DoesNotFit& cause) {
        EXPECT_EQ(s.points, before);
        const int fewer = carriers_that_fit(s, test_key(), options, cause);
        EXPECT_GT(fewer, 100);
        EXPECT_LT(fewer, 1024);
        EXPECT_EQ(s.points, before);
        embed(s, test_key(), options_for(Statistic::Mean, fewer));
    }
}

// geodesic.md, and half of what the thesis reports in Table 4.2 (0.46 to 0.64): ratios to Cho do not depend on scale.
TEST(Geodesic, DistortsAQuarterOfChoAtMost)
{
    for (const char* mesh : {"bunny00.off", "fandisk.off"})
        for (const Statistic statistic : {Statistic::Mean, Statistic::Variance}) {
            EmbedOptions options = options_for(statistic, 64);
            Surface ours = load(mesh);
            const EmbedReport report = embed(ours, test_key(), options);
            EXPECT_LE(report.moves->unconverged, 0.002 * report.moves->total());
            options.carriers.method = Method::Cho;
            Surface cho = load(mesh);
            EXPECT_LT(report.mrms, 0.25 * embed(cho, test_key(), options).mrms);
        }
}

} // namespace
