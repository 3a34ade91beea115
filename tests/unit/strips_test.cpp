// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/load.h"
#include "support/shapes.h"
#include "support/topology.h"
#include "vcg_ext/attack/noise.h"
#include "vcg_ext/base/error.h"
#include "vcg_ext/carrier/statistic.h"
#include "vcg_ext/carrier/strips.h"
#include "vcg_ext/key/key.h"
#include "vcg_ext/watermark/watermark.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

const Key& test_key()
{
    static const Key key("strips_test");
    return key;
}

Strips strips_about(const SurfacePoint& source, const Surface& s, int count)
{
    const int vertices = static_cast<int>(s.points.size());
    const Fans fans = fans_of(vertex_faces(vertices, s.triangles), s.triangles);
    return strips_from({source, {}, false, {}}, distances_from(source, s.points, s.triangles, fans), vertices, 0.1,
                       count);
}

SurfacePoint keyed_source(const Surface& s, const Key& key)
{
    return strip_frame(s, principal_frame(s), source_directions(key.stream("direction"))).source;
}

TEST(KeyedSource, FollowsTheBody)
{
    const Surface cover = load("elephant.off");
    const Point axis(1, 2, 3);
    const SurfacePoint here = keyed_source(cover, test_key());
    const SurfacePoint there = keyed_source(shapes::moved(cover, 2, 1, axis, {5, 6, 7}), test_key());
    EXPECT_EQ(here.face, there.face);
    Surface point;
    point.points = {here.position};
    EXPECT_LT((shapes::moved(point, 2, 1, axis, {5, 6, 7}).points[0] - there.position).norm(), 1e-12);
}

TEST(KeyedSource, EachKeyHasItsOwn)
{
    const Surface s = load("elephant.off");
    EXPECT_GT((keyed_source(s, Key("one")).position - keyed_source(s, Key("two")).position).norm(), 1e-3);
}

TEST(KeyedSource, DirectionsAreEvenOverTheSphere)
{
    // On a sphere the frame is arbitrary but fixed, so directions are as even as draws: mean 0.
    const Surface s = shapes::sphere(2);
    constexpr int keys = 12; // deriving a key costs a tenth of a second
    Point mean = Point::Zero();
    for (int k = 0; k < keys; ++k)
        mean += keyed_source(s, Key("direction " + std::to_string(k))).position / keys;
    // 3 keys |mean|^2 is about chi^2 with 3 degrees: p < 0.01 beyond 11.3.
    EXPECT_LT(mean.norm(), std::sqrt(11.3 / (3 * keys)));
}

TEST(KeyedSource, LooksOnWhereARayMisses)
{
    // Two boxes and nothing about the centre between them: one ray in fifty hits.
    const Surface s = joined(shapes::moved(shapes::box(1, 1, 1), 1, 0, {1, 0, 0}, {-6, 0, 0}), shapes::box(1, 1, 1));
    EXPECT_GE(keyed_source(s, test_key()).face, 0);
}

TEST(KeyedSource, SaysWhereNoRayCanHit)
{
    const Surface flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 0, 0}, {9, 1, 0}, {8, 0, 0}}, {{0, 1, 2}, {3, 4, 5}}};
    EXPECT_THROW((void)keyed_source(flat, test_key()), Error);
}

TEST(Strips, AreCutFromTheSourceToTheFarthestVertex)
{
    const Surface s = shapes::sphere(5);
    const SurfacePoint source = *farthest_hit(s, Point::Zero(), Point(3, 2, 1));
    const Strips strips = strips_about(source, s, 16);
    const double pi = std::acos(-1.0);
    double farthest = 0; // over vertices
    for (const Point& p : s.points)
        farthest = std::max(farthest, std::acos(std::clamp(p.dot(source.position.normalized()), -1.0, 1.0)));
    EXPECT_NEAR(strips.farthest, farthest, 0.03);
    EXPECT_DOUBLE_EQ(strips.carriers.low, 0.1 * strips.farthest);
    EXPECT_DOUBLE_EQ(strips.carriers.width, 0.05 * strips.farthest);
    EXPECT_EQ(strips.unreached, 0);
    // The zone between two angles has the area 2 pi (cos a - cos b), of 4 pi.
    const std::vector<int> count = samples(strips.carriers);
    for (int k = 0; k < 16; ++k) {
        const double a = pi * (0.1 + 0.05 * k);
        const double share = (std::cos(a) - std::cos(a + 0.05 * pi)) / 2;
        EXPECT_NEAR(count[k], share * static_cast<double>(s.points.size()),
                    0.1 * share * static_cast<double>(s.points.size()));
    }
}

TEST(Strips, OtherPartsCarryNothing)
{
    const Surface sphere = shapes::sphere(4);
    const Surface s = joined(sphere, shapes::moved(shapes::box(1, 1, 1), 0.1, 0, {1, 0, 0}, {0, 0, 0}));
    const SurfacePoint source{0, s.points[s.triangles[0][0]]};
    const Strips strips = strips_about(source, s, 8);
    EXPECT_EQ(strips.unreached, 8);
    EXPECT_NEAR(strips.farthest, std::acos(-1.0), 0.05);
    for (std::size_t v = sphere.points.size(); v < s.points.size(); ++v)
        EXPECT_EQ(strips.carriers.label[v], -1);
}

TEST(Strips, PointIsCarriedAlong)
{
    const Surface s = shapes::sphere(2);
    const auto& [a, b, c] = s.triangles[7];
    const SurfacePoint source{7, 0.2 * s.points[a] + 0.5 * s.points[b] + 0.3 * s.points[c]};
    Points other = s.points;
    for (Point& p : other)
        p = Point(p.x() + 2 * p.y(), 3 * p.z(), p.x() * p.y());
    const SurfacePoint carried = carried_along(source, s, other);
    EXPECT_EQ(carried.face, 7);
    EXPECT_LT((carried.position - (0.2 * other[a] + 0.5 * other[b] + 0.3 * other[c])).norm(), 1e-14);
}

/// The rounds of smoothing after which a detector reads the mark of a mesh that `spoil` was done to.
template <class Spoil>
int rounds_of(const Surface& cover, const Spoil& spoil)
{
    EmbedOptions options;
    options.carriers.method = Method::Geodesic;
    options.message = read_message("bits:1011");
    options.carriers.bits = 32;
    Surface surface = cover;
    embed(surface, test_key(), options);
    surface.points = spoil(surface);
    DetectOptions reading;
    reading.carriers.method = options.carriers.method;
    reading.carriers.bits = options.carriers.bits;
    return detect(surface, test_key(), reading).smoothing_rounds.value_or(-1);
}

TEST(ReadStrips, SmoothsWhatIsRoughAndNothingElse)
{
    EXPECT_EQ(rounds_of(load("fandisk.off"), [](const Surface& s) { return s.points; }), 0);
    EXPECT_GT(rounds_of(load("bunny00.off"), [](const Surface& s) { return noise(s, 0.003, 1); }), 0);
}

} // namespace
