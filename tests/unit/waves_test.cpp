// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/load.h"
#include "support/shapes.h"
#include "support/topology.h"
#include "vcg_ext/attack/attack.h"
#include "vcg_ext/base/parallel.h"
#include "vcg_ext/base/weld.h"
#include "vcg_ext/carrier/wave_evidence.h"
#include "vcg_ext/geometry/solid_transform.h"
#include "vcg_ext/key/random.h"
#include "vcg_ext/method/wave_embedding.h"
#include "vcg_ext/method/waves.h"
#include "vcg_ext/placement/fold_guard.h"
#include "vcg_ext/placement/wave_field.h"

#include <cmath>
#include <gtest/gtest.h>

namespace {

using namespace vcg_ext;

constexpr double decade = 2.302585092994046;
constexpr int waves = 64;

const Key& test_key()
{
    static const Key key("waves_test");
    return key;
}

Bits coins(const Key& key, const char* purpose, int count)
{
    Stream draws = key.stream(purpose);
    Bits bits;
    for (int i = 0; i < count; ++i)
        bits.push_back(static_cast<std::uint8_t>(draws.below(2)));
    return bits;
}

Points as_float(const Points& points)
{
    Points result;
    for (const Point& p : points)
        result.emplace_back(p.cast<float>().cast<double>());
    return result;
}

/// A body of some 10,000 vertices with three different axes and a bump.
Surface body(int levels = 5)
{
    Surface s = shapes::sphere(levels);
    for (Point& p : s.points) {
        const double bump = 0.2 * std::exp(-4 * (p - Point(0.6, 0.5, 0.62)).squaredNorm());
        p = (1 + bump) * Point((1.4 + 0.2 * p[1]) * p[0] + 0.15 * p[0] * p[0], p[1] + 0.1 * p[1] * p[1], 0.75 * p[2]);
    }
    return s;
}

struct Marked {
    Surface cover;
    Surface stego;
    Bits coded;
    WaveEmbedding report;
};

Marked mark(const Surface& cover, double strength = 1e-4)
{
    Marked result;
    result.cover = cover;
    result.coded = coins(test_key(), "message", waves);
    result.report = embed_waves(Cover(result.cover), wave_plan(test_key(), waves), result.coded, strength, as_float);
    result.stego = {result.report.points, cover.triangles};
    return result;
}

const Marked& marked_body()
{
    static const Marked marked = mark(body());
    return marked;
}

struct Found {
    WavePresence presence;
    WaveMatch match;
};

Found find(const Surface& surface, const Bits& coded, const Key& key = test_key(), const WaveReadOptions& options = {})
{
    WaveSpectra spectra(wave_body(weld(surface).surface));
    const WaveReading reading = read_waves(spectra, wave_plan(key, static_cast<int>(coded.size())), options);
    const WavePresence presence = wave_presence(reading);
    return {presence, wave_match(reading, presence, coded)};
}

TEST(WavePlan, IsUniformInItsShell)
{
    const WavePlan plan = wave_plan(test_key(), 20000);
    Point mean = Point::Zero();
    int inner = 0;
    double dither = 0;
    for (int k = 0; k < plan.count(); ++k) {
        const double length = plan.vectors[k].norm();
        ASSERT_GE(length, 10);
        ASSERT_LE(length, 20);
        mean += plan.vectors[k] / plan.count();
        inner += length < 15;
        dither += plan.dithers[k] / plan.count();
    }
    EXPECT_LT(mean.norm(), 0.3);
    EXPECT_NEAR(inner / 20000.0, (3375.0 - 1000) / (8000 - 1000), 0.015);
    EXPECT_NEAR(dither, 0.5, 0.01);
    EXPECT_EQ(wave_plan(test_key(), 64).vectors[63], plan.vectors[63]); // more waves leave the first as they are
}

TEST(WaveGrid, WeightsSumToOne)
{
    double sum = 0;
    for (const WaveGrid::Row& row : wave_grid().rows)
        for (const double weight : row.log_weight)
            sum += std::exp(weight);
    EXPECT_NEAR(sum, 1, 1e-9);
    double views = 0;
    WaveSpectra spectra(wave_body(body(3)));
    for (const WaveView& view : read_waves(spectra, wave_plan(test_key(), 8)).views)
        views += std::exp(view.log_weight);
    EXPECT_NEAR(views, 1, 1e-9);
}

TEST(WaveStep, IsWhatThatDisplacementDoes)
{
    // The RMS of what embedding does is the strength, but for the ladder's steps of sqrt 2.
    for (const double strength : {3e-5, 1e-4, 5e-4}) {
        const Marked marked = mark(body(4), strength);
        EXPECT_GT(marked.report.moved, strength * 0.7);
        EXPECT_LT(marked.report.moved, strength * 1.5);
    }
}

TEST(WaveField, IsTheLeastThatMakesTheChange)
{
    // To first order, m_k changes by the integral of s w_k over 4 pi: against the transform of the displaced solid,
    // whose frame is held.
    const Surface surface = body();
    const WaveBody solid = wave_body(surface);
    const WavePlan plan = wave_plan(test_key(), waves);
    const WaveField field(solid, plan);
    std::vector<double> change(waves);
    for (int k = 0; k < waves; ++k)
        change[k] = 1e-6 * std::sin(k * 2.1);
    const std::vector<double> s = field.least(change);
    const Points directions = offset_directions(solid);
    WaveBody moved = solid;
    for (std::size_t v = 0; v < s.size(); ++v)
        moved.points[v] += s[v] * directions[v];
    const auto values = [&](const WaveBody& b) {
        return wave_values_of(solid_transform(b.points, b.topology.triangles, plan.vectors), plan.phases, false);
    };
    const std::vector<double> before = values(solid);
    const std::vector<double> after = values(moved);
    for (int k = 0; k < waves; ++k)
        EXPECT_NEAR(after[k] - before[k], change[k], 5e-8) << k;
}

TEST(OffsetDirections, KeepPlanesPlanarBesideCreases)
{
    // All faces of a box that is cut finely move outward by one: so do its edges and corners.
    const WaveBody solid = wave_body(shapes::box(3, 2, 1));
    const Points directions = offset_directions(solid);
    for (int f = 0; f < solid.topology.surface_triangles; ++f) {
        const Point n = scaled_normal(solid.points, solid.topology.triangles[f]).normalized();
        for (const int v : solid.topology.triangles[f])
            EXPECT_NEAR(n.dot(directions[v]), 1, 2e-3);
    }
}

TEST(Waves, AllGoTheSamePartOfTheWayToTheirLattice)
{
    const Marked& marked = marked_body();
    EXPECT_LT(marked.report.worst, 0.01);
    const WavePlan plan = wave_plan(test_key(), waves);
    const auto values = [&](const Surface& surface) {
        const WaveBody solid = wave_body(surface);
        return wave_values_of(solid_transform(solid.points, solid.topology.triangles, plan.vectors), plan.phases,
                              false);
    };
    const std::vector<double> before = values(marked.cover);
    const std::vector<double> after = values(marked.stego);
    const double part = marked.report.part;
    EXPECT_GE(part, 0.7);
    EXPECT_LE(part, 1);
    for (int k = 0; k < waves; ++k) {
        const double goal = before[k] + (after[k] - before[k]) / part;
        const double y = goal / marked.report.step - plan.dithers[k] - marked.coded[k] * 0.5;
        EXPECT_NEAR(y, std::round(y), 0.011 / part) << k;
    }
    EXPECT_TRUE(folded_faces(Cover(marked.cover), marked.stego.points).empty());
}

TEST(Waves, SurviveWhatLeavesTheShape)
{
    const Marked& marked = marked_body();
    const Found plain = find(marked.stego, marked.coded);
    EXPECT_LT(plain.match.log_p, -18 * decade);
    EXPECT_LT(plain.presence.log_p, -20 * decade);

    const Surface moved =
        shapes::renumbered(shapes::moved(marked.stego, 7, 2.1, Point(2, -1, 2) / 3, {30, -20, 10}), 3);
    EXPECT_LT(find(moved, marked.coded).match.log_p, -18 * decade);
    EXPECT_LT(find(soup(moved), marked.coded).match.log_p, -18 * decade);

    Surface mirrored = marked.stego;
    for (Point& p : mirrored.points)
        p[0] = -p[0];
    EXPECT_LT(find(mirrored, marked.coded).match.log_p, -18 * decade); // inside out now
    for (Triangle& t : mirrored.triangles)
        std::swap(t[0], t[1]);
    EXPECT_LT(find(mirrored, marked.coded).match.log_p, -18 * decade);

    Surface hole = marked.stego;
    hole.triangles.erase(hole.triangles.begin() + 100, hole.triangles.begin() + 103);
    EXPECT_LT(find(hole, marked.coded).match.log_p, -17 * decade);
}

TEST(Waves, SurviveRemeshingAndSmoothing)
{
    const Marked& marked = marked_body();
    struct Case {
        Attack attack;
        double amount;
        int iterations;
    };
    for (const Case& c : {Case{Attack::Simplify, 0.75, -1}, Case{Attack::Isosurface, 0.01, -1},
                          Case{Attack::Smooth, 0.5, 5}, Case{Attack::Smooth, 0.5, 10}, Case{Attack::Noise, 0.001, -1},
                          Case{Attack::Subdivide, -1, -1}, Case{Attack::Remesh, 1, 3}}) {
        Surface attacked = marked.stego;
        apply_attack(attacked, {c.attack, c.amount, c.iterations, 3});
        const Found found = find(attacked, marked.coded);
        EXPECT_LT(found.match.log_p, -12 * decade) << name(c.attack) << ' ' << c.iterations;
        EXPECT_LT(found.presence.log_p, -6 * decade) << name(c.attack) << ' ' << c.iterations;
    }
}

TEST(Waves, OfAnyStrengthSurviveSmoothing)
{
    CarrierOptions options;
    options.method = Method::Waves;
    options.bits = waves;
    const Plan plan = plan_waves(test_key(), options);
    for (const double strength : {2.5e-5, 1e-4, 4e-4, 2e-3}) {
        const Marked marked = mark(body(), strength);
        Surface smoothed = marked.stego;
        apply_attack(smoothed, {Attack::Smooth, 0.5, 5, 3});
        const Readings readings = read_by_waves(smoothed, plan, find_waves(smoothed, plan));
        EXPECT_LT(readings.presence, -6) << strength;
        EXPECT_LT(readings.match(marked.coded), -12) << strength;
        EXPECT_GT(readings.match(coins(test_key(), "another message", waves)), -3) << strength;
    }
}

TEST(Waves, AFirstLookAtRestIsAPartOfTheWholeReading)
{
    const Marked& marked = marked_body();
    WaveReadOptions at_rest;
    at_rest.at_rest_only = true;
    const Found quick = find(marked.stego, marked.coded, test_key(), at_rest);
    const Found whole = find(marked.stego, marked.coded);
    EXPECT_LT(quick.presence.log_p, -20 * decade);
    EXPECT_LE(whole.presence.log_p, quick.presence.log_p);
    EXPECT_LT(quick.match.log_p, -18 * decade);
}

/// Round but for its lobes, so two of its variances are equal; another at each end.
Surface lobed(int lobes, double depth)
{
    Surface s = shapes::sphere(4);
    for (Point& p : s.points) {
        const double around = std::hypot(p[0], p[1]);
        const double lobe = 1 + depth * std::pow(around, lobes) * std::cos(lobes * std::atan2(p[1], p[0]));
        p = Point(lobe * p[0], lobe * p[1], 1.6 * p[2] + 0.3 * p[2] * p[2]);
    }
    return s;
}

TEST(Waves, RoundBodiesAreHeldByTheirLobes)
{
    for (const int lobes : {3, 4}) {
        const Surface cover = lobed(lobes, 0.1);
        const WaveBody solid = wave_body(cover);
        EXPECT_EQ(solid.fold, lobes);
        EXPECT_EQ(solid.odd_axis, 0);
        EXPECT_TRUE(solid.turns[0].isIdentity(1e-12));
        const Marked marked = mark(cover);
        Surface moved = shapes::renumbered(shapes::moved(marked.stego, 7, 2.1, Point(2, -1, 2) / 3, {30, -20, 10}), 3);
        EXPECT_LT(find(moved, marked.coded).match.log_p, -17 * decade) << lobes;
        for (Point& p : moved.points)
            p[0] = -p[0];
        EXPECT_LT(find(moved, marked.coded).match.log_p, -17 * decade) << lobes << ", mirrored";
    }
}

TEST(Waves, SoftValuesHaveTheSignsOfTheBits)
{
    const Marked& marked = marked_body();
    WaveSpectra spectra(wave_body(marked.stego));
    const WaveReading reading = read_waves(spectra, wave_plan(test_key(), waves));
    const WavePresence presence = wave_presence(reading);
    const std::vector<WaveSoft> ways = wave_ways(reading, presence, 10);
    ASSERT_FALSE(ways.empty());
    for (std::size_t i = 1; i < ways.size(); ++i)
        EXPECT_GE(ways[i - 1].weight, ways[i].weight);
    for (int k = 0; k < waves; ++k)
        EXPECT_EQ(ways[0].soft[k] > 0, marked.coded[k] == 1);
    double sum = 0;
    for (const WaveSoft& way : ways)
        sum += way.weight;
    EXPECT_LE(sum, 1 + 1e-9);
}

TEST(WaveSpectra, ReadTheSameWhateverWasReadBefore)
{
    WaveSpectra grown(wave_body(marked_body().stego));
    for (const int count : {8, 32, 20}) {
        WaveSpectra fresh(wave_body(marked_body().stego));
        const WaveReading first = read_waves(fresh, wave_plan(test_key(), count));
        const WaveReading again = read_waves(grown, wave_plan(test_key(), count));
        ASSERT_EQ(first.views.size(), again.views.size());
        for (std::size_t i = 0; i < first.views.size(); ++i) {
            EXPECT_EQ(first.views[i].phase, again.views[i].phase);
            EXPECT_EQ(first.views[i].bend, again.views[i].bend);
            EXPECT_EQ(first.views[i].undone, again.views[i].undone);
        }
    }
    const WaveReading other = read_waves(grown, wave_plan(Key("another"), 8));
    WaveSpectra fresh(wave_body(marked_body().stego));
    EXPECT_EQ(other.views[0].phase, read_waves(fresh, wave_plan(Key("another"), 8)).views[0].phase);
}

TEST(Waves, ThreadsHaveNoPartInTheResult)
{
    const Surface cover = body(4);
    set_threads(1);
    const Marked one = mark(cover);
    const Found first = find(one.stego, one.coded);
    set_threads(5);
    const Marked five = mark(cover);
    const Found second = find(five.stego, five.coded);
    set_threads(0);
    EXPECT_EQ(one.report.points, five.report.points);
    EXPECT_EQ(first.match.log_p, second.match.log_p);
    EXPECT_EQ(first.presence.log_p, second.presence.log_p);
}

TEST(Waves, RefuseWhatHasNoFrameAndWhatIsTooCoarse)
{
    const WavePlan plan = wave_plan(test_key(), waves);
    const Bits coded = coins(test_key(), "message", waves);
    const auto refusal = [&](const Surface& surface) -> std::string {
        try {
            (void)embed_waves(Cover(surface), plan, coded, 1e-4, as_float);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(refusal(shapes::sphere(4)).find("every direction"), std::string::npos);
    Surface cube = shapes::box(1, 1, 1);
    apply_attack(cube, {Attack::Subdivide, -1, 5, 0});
    EXPECT_NE(refusal(cube).find("every direction"), std::string::npos);
    EXPECT_NE(refusal(lobed(3, 0)).find("round about one of its axes"), std::string::npos);
    EXPECT_NE(refusal(body(1)).find("vertices"), std::string::npos);
    EXPECT_NE(refusal(shapes::triangular_grid(3, 2, 0.1)).find("encloses nothing"), std::string::npos);
}

/// How often each claimed bound is undercut: `claims` of n detections that had no mark of that key to find.
void expect_honest(const std::vector<double>& claims, const char* what)
{
    for (const double level : {0.1, 0.01, 0.001}) {
        int below = 0;
        for (const double log_p : claims)
            below += log_p <= std::log(level);
        const double expected = level * static_cast<double>(claims.size());
        EXPECT_LE(below, expected + 3 * std::sqrt(expected) + 1) << what << " at " << level;
    }
}

TEST(Waves, BoundsHoldWhereDithersAndMasksAreDrawnAnew)
{
    // Dithers redrawn stand for other keys: the phases move by uniform shifts, and nothing else has to be computed.
    // Masks redrawn stand for another mask under the same plan, on a mesh that is marked: there the phases do gather.
    const Marked& marked = marked_body();
    WaveReadOptions options;
    options.lowest_rung = options.highest_rung = 0;
    options.mirrored = false;
    const int draws = 10000; // of dithers; and half as many masks
    WaveGrid small;          // the bounds' logic at a cost that allows many draws
    small.step = wave_grid().step;
    for (const WaveGrid::Row& row : wave_grid().rows)
        if (row.undone < 0 && std::abs(row.t) < 0.35)
            small.rows.push_back(row);
    double all = 0;
    for (const WaveGrid::Row& row : small.rows)
        for (const double weight : row.log_weight)
            all += std::exp(weight);
    for (WaveGrid::Row& row : small.rows)
        for (double& weight : row.log_weight)
            weight -= std::log(all);

    for (const bool is_marked : {false, true}) {
        const Surface& surface = is_marked ? marked.stego : marked.cover;
        WaveBody solid = wave_body(surface);
        solid.turns.resize(1);
        WaveSpectra spectra(solid);
        WaveReading reading = read_waves(spectra, wave_plan(test_key(), waves), options);
        reading.grid = &small;
        const WavePresence own = wave_presence(reading);
        const std::vector<WaveView> views = reading.views;
        Stream stream = seeded_stream(1, "waves_test");
        std::vector<double> known, alone, masked;
        Bits coded(waves);
        for (int i = 0; i < draws; ++i) {
            for (auto& bit : coded)
                bit = static_cast<std::uint8_t>(stream.below(2));
            if (i % 2 == 0)
                masked.push_back(wave_match(reading, own, coded).log_p);
            WaveReading other = reading;
            for (int k = 0; k < waves; ++k) {
                const double shift = uniform(stream);
                for (WaveView& view : other.views)
                    view.phase[k] += shift;
            }
            const WavePresence presence = wave_presence(other);
            alone.push_back(presence.log_p);
            known.push_back(wave_match(other, presence, coded).log_p);
        }
        expect_honest(alone, "key alone");
        expect_honest(known, "message known");
        expect_honest(masked, "another mask");
    }
}

} // namespace
