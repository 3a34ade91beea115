// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/load.h"
#include "support/shapes.h"
#include "support/topology.h"
#include "vcg_ext/attack/attack.h"
#include "vcg_ext/base/error.h"
#include "vcg_ext/base/parallel.h"
#include "vcg_ext/base/progress.h"
#include "vcg_ext/base/weld.h"
#include "vcg_ext/carrier/statistic.h"
#include "vcg_ext/geometry/normals.h"
#include "vcg_ext/method/methods.h"
#include "vcg_ext/placement/cover.h"
#include "vcg_ext/watermark/watermark.h"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace vcg_ext;

namespace {

const Key& test_key()
{
    static const Key key("watermark_test");
    return key;
}

EmbedOptions options_for(Method method, Statistic statistic)
{
    EmbedOptions options;
    options.carriers.method = method;
    options.carriers.statistic = statistic;
    options.carriers.bits = 64;
    options.message = read_message("museum");
    return options;
}

DetectReport read(const Surface& surface, const EmbedOptions& embedded, const Key& key = test_key())
{
    DetectOptions options;
    options.carriers = embedded.carriers;
    options.expected = {embedded.message};
    return detect(surface, key, options);
}

struct Case {
    Method method;
    Statistic statistic;
};

class EveryMethod : public testing::TestWithParam<Case> {
protected:
    EmbedOptions options = options_for(GetParam().method, GetParam().statistic);
};

TEST_P(EveryMethod, ReadsItsMessageBack)
{
    for (const char* mesh : {"bunny00.off", "fandisk.off"}) {
        const Surface cover = load(mesh);
        Surface stego = cover;
        const EmbedReport report = embed(stego, test_key(), options);
        EXPECT_EQ(report.detection_ratio, 1);
        EXPECT_EQ(stego.triangles, cover.triangles);

        const DetectReport found = read(stego, options);
        EXPECT_EQ(found.bits, report.bits);
        EXPECT_EQ(found.finding, Verdict::Present);
        EXPECT_EQ(*found.detection_ratio, 1);
        if (row_of(options.carriers.method).is_smooth) { // its carriers are no coins alone: magnitudes count
            EXPECT_LT(*found.p_value, std::ldexp(1.0, -50));
        } else {
            const double orientations = options.carriers.method == Method::Spectral ? 4 : 1;
            EXPECT_NEAR(*found.p_value, orientations * std::ldexp(1.0, -64), std::ldexp(1.0, -100));
        }
        EXPECT_TRUE(*found.present);
        for (int i = 0; i < 64; ++i)
            EXPECT_EQ(found.soft[i] > 0, found.bits[i] == 1);
    }
}

TEST_P(EveryMethod, TurnsNoFaceOver)
{
    const Surface cover = load("fandisk.off");
    Surface stego = cover;
    embed(stego, test_key(), options);
    const Points before = face_normals(cover.points, cover.triangles);
    const Points after = face_normals(stego.points, stego.triangles);
    for (std::size_t f = 0; f < before.size(); ++f)
        EXPECT_TRUE(before[f].isZero() || before[f].dot(after[f]) > 0) << f;
}

TEST_P(EveryMethod, SurvivesSimilarityAndRenumbering)
{
    Surface stego = load("fandisk.off");
    embed(stego, test_key(), options);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.5, Point(3, -1, 2).normalized()).toRotationMatrix();
    std::vector<int> order = Key("order").stream("test").permutation(static_cast<int>(stego.points.size()));
    Surface moved = stego;
    for (std::size_t v = 0; v < order.size(); ++v)
        moved.points[order[v]] = 0.31 * (turn * stego.points[v]) + Point(5, 6, 7);
    for (Triangle& t : moved.triangles)
        for (int& v : t)
            v = order[v];
    std::reverse(moved.triangles.begin(), moved.triangles.end());
    EXPECT_EQ(*read(moved, options).detection_ratio, 1);
}

TEST_P(EveryMethod, KeepsASoupClosed)
{
    const Surface cover = load("fandisk.off");
    Surface torn = soup(cover);
    Surface stego = cover;
    const EmbedReport welded = embed(stego, test_key(), options);
    embed(torn, test_key(), options);
    EXPECT_EQ(weld(torn).surface.points.size(), cover.points.size());
    // The same mark, to the bit, as on the mesh with shared vertices.
    for (std::size_t f = 0; f < cover.triangles.size(); ++f)
        for (int k = 0; k < 3; ++k)
            ASSERT_EQ(torn.points[3 * f + k], stego.points[cover.triangles[f][k]]);
    EXPECT_EQ(read(weld(torn).surface, options).bits, welded.bits);
}

TEST_P(EveryMethod, LeavesHeldVertices)
{
    Surface cover = load("armadillo.off");
    cover.points = rounded_to_float(cover.points);
    options.held.resize(cover.points.size());
    for (std::size_t v = 0; v < cover.points.size(); v += 7)
        options.held[v] = 1;
    Surface marked = cover;
    EXPECT_EQ(embed(marked, test_key(), options).detection_ratio, 1);
    EXPECT_TRUE(*read(marked, options).present);
    const bool slides = !row_of(options.carriers.method).is_smooth;
    for (std::size_t v = 0; slides && v < cover.points.size(); v += 7)
        EXPECT_EQ(marked.points[v], cover.points[v]);
}

TEST_P(EveryMethod, GivesTheSameAtAnyNumberOfThreads)
{
    Surface alone = load("fandisk.off");
    Surface together = alone;
    set_threads(1);
    embed(alone, test_key(), options);
    const DetectReport read_alone = read(alone, options);
    set_threads(4);
    embed(together, test_key(), options);
    const DetectReport read_together = read(together, options);
    set_threads(0);
    EXPECT_EQ(alone.points, together.points);
    EXPECT_EQ(read_alone.soft, read_together.soft);
}

TEST_P(EveryMethod, LeavesTheMeshWhereCancelled)
{
    const Surface cover = load("fandisk.off");
    int calls = 0;
    Surface stego = cover;
    embed(stego, test_key(), options, [&](int, const char*) { return ++calls > 0; });
    ASSERT_GT(calls, 3);
    for (int stop = 1; stop <= calls; ++stop) {
        Surface surface = cover;
        int call = 0;
        EXPECT_THROW(embed(surface, test_key(), options, [&](int, const char*) { return ++call < stop; }), Cancelled);
        EXPECT_EQ(surface.points, cover.points);
    }
}

TEST_P(EveryMethod, MovesNothingButFloatsInFloatStorage)
{
    Surface stego = load("fandisk.off");
    embed(stego, test_key(), options);
    for (const Point& p : stego.points)
        for (const double x : p)
            EXPECT_EQ(x, static_cast<double>(static_cast<float>(x)));
}

TEST_P(EveryMethod, InDoubleStorageSurvivesFloatFiles)
{
    Surface stego = load("fandisk.off");
    options.placement.storage = Storage::Double;
    embed(stego, test_key(), options);
    EXPECT_EQ(*read(stego, options).detection_ratio, 1);
    stego.points = rounded_to_float(stego.points);
    EXPECT_EQ(*read(stego, options).detection_ratio, 1);
}

INSTANTIATE_TEST_SUITE_P(Watermark, EveryMethod,
                         testing::Values(Case{Method::Layered, Statistic::Mean}, Case{Method::Waves, Statistic::Mean},
                                         Case{Method::LM, Statistic::Mean}, Case{Method::LM, Statistic::Variance},
                                         Case{Method::QSP, Statistic::Mean}, Case{Method::QSP, Statistic::Variance},
                                         Case{Method::Cho, Statistic::Mean}, Case{Method::Cho, Statistic::Variance},
                                         Case{Method::Geodesic, Statistic::Mean},
                                         Case{Method::Geodesic, Statistic::Variance},
                                         Case{Method::Spectral, Statistic::Mean}),
                         [](const auto& info) {
                             std::string text = std::string(name(info.param.method)) + name(info.param.statistic);
                             text.erase(std::remove(text.begin(), text.end(), '-'), text.end());
                             return text;
                         });

// Matches under wrong keys are Binomial(64, 1/2). Chi-square over classes that each expect five or more of 200.
TEST(WrongKeys, MatchByEvenChance)
{
    Surface stego = load("fandisk.off");
    const EmbedOptions options = options_for(Method::Cho, Statistic::Mean);
    embed(stego, test_key(), options);
    constexpr int keys = 200;
    constexpr std::array<int, 9> upper = {26, 28, 30, 31, 32, 33, 35, 37, 64}; // last count of matches in each class
    std::array<double, upper.size()> expected{};
    std::array<int, upper.size()> seen{};
    const auto class_of = [&](int matches) {
        return std::lower_bound(upper.begin(), upper.end(), matches) - upper.begin();
    };
    for (int k = 0; k <= 64; ++k)
        expected[class_of(k)] +=
            keys * std::exp(std::lgamma(65) - std::lgamma(k + 1) - std::lgamma(65 - k)) * std::ldexp(1.0, -64);
    for (int i = 0; i < keys; ++i) {
        const DetectReport found = read(stego, options, Key("wrong " + std::to_string(i)));
        ++seen[class_of(static_cast<int>(std::lround(*found.detection_ratio * 64)))];
        EXPECT_FALSE(*found.present);
    }
    double chi2 = 0;
    for (std::size_t c = 0; c < upper.size(); ++c) {
        EXPECT_GE(expected[c], 5);
        chi2 += (seen[c] - expected[c]) * (seen[c] - expected[c]) / expected[c];
    }
    EXPECT_LT(chi2, 20.09); // 8 degrees of freedom, p = 0.01
}

/// What the error says, or "" where there is none. The surface must stay as it was.
std::string refusal(const Surface& surface, const EmbedOptions& options)
{
    Surface changed = surface;
    std::string text;
    try {
        embed(changed, test_key(), options);
    } catch (const Error& error) {
        text = error.what();
        EXPECT_EQ(changed.points.size(), surface.points.size());
        for (std::size_t v = 0; v < surface.points.size(); ++v)
            EXPECT_TRUE(changed.points[v] == surface.points[v] || !surface.points[v].allFinite());
    }
    return text;
}

TEST(Embed, RefusesWithACauseAndLeavesTheMesh)
{
    const EmbedOptions good = options_for(Method::Cho, Statistic::Mean);
    const Surface fandisk = load("fandisk.off");
    const auto with = [&](auto change) {
        EmbedOptions options = good;
        change(options);
        return refusal(fandisk, options);
    };
    EXPECT_NE(with([](auto& o) { o.carriers.bits = -1; }).find("between 1 and 1024"), std::string::npos);
    EXPECT_NE(with([](auto& o) { o.carriers.bits = 1025; }).find("between 1 and 1024"), std::string::npos);
    EXPECT_NE(with([](auto& o) { o.carriers.bits = 16; }).find("48 bits"), std::string::npos);
    EXPECT_NE(with([](auto& o) { o.carriers.trim = 0.5; }).find("between 0 and 0.45"), std::string::npos);
    EXPECT_NE(with([](auto& o) { o.placement.strength = -0.1; }).find("Strength"), std::string::npos);
    EXPECT_NE(with([](auto& o) { o.placement.strength = 0.5; }).find("Strength"), std::string::npos);
    EXPECT_NE(with([](auto& o) { o.placement.strength = std::nan(""); }).find("Strength"), std::string::npos);

    EXPECT_NE(refusal({}, good).find("no faces"), std::string::npos);
    EXPECT_NE(refusal({fandisk.points, {}}, good).find("no faces"), std::string::npos);
    EXPECT_NE(refusal({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}}}, good).find("distinct"), std::string::npos);
    Surface broken = fandisk;
    broken.points[7].y() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(refusal(broken, good).find("finite"), std::string::npos);
    broken.points[7].y() = std::numeric_limits<double>::infinity();
    EXPECT_NE(refusal(broken, good).find("finite"), std::string::npos);
    EXPECT_NE(refusal(load("octahedron.off"), good).find("equally far"), std::string::npos);
    EmbedOptions many = good;
    many.carriers.bits = 1024;
    EXPECT_NE(refusal(load("cow.off"), many).find("carriers hold no vertex"), std::string::npos);
    EXPECT_NE(with([](auto& o) { o.placement.max_rounds = 0; }).find("round"), std::string::npos);
    EXPECT_NE(with([](auto& o) { o.placement.sphere.sweeps = 0; }).find("sweep"), std::string::npos);
    EXPECT_NE(with([](auto& o) { o.placement.sphere.weights = {0, 0, 0}; }).find("weights"), std::string::npos);

    Surface far = fandisk;
    for (Point& p : far.points)
        p.x() += 1e6 * bounding_diagonal(fandisk);
    EXPECT_NE(refusal(far, good).find("origin"), std::string::npos);
}

TEST(Embed, WorksAtAnySizeThatDoublesHold)
{
    for (const double scale : {1e-30, 1e30}) {
        Surface surface = load("fandisk.off");
        for (Point& p : surface.points)
            p *= scale;
        EmbedOptions options = options_for(Method::LM, Statistic::Mean);
        embed(surface, test_key(), options);
        EXPECT_EQ(*read(surface, options).detection_ratio, 1);
    }
}

TEST(Embed, AgainMovesNothing)
{
    Surface surface = load("bunny00.off");
    const EmbedOptions options = options_for(Method::LM, Statistic::Mean);
    EXPECT_GT(embed(surface, test_key(), options).mrms, 0);
    EXPECT_EQ(embed(surface, test_key(), options).moved_vertices, 0);
}

TEST(Embed, LeavesVerticesWithoutFaces)
{
    Surface surface = load("fandisk.off");
    surface.points.insert(surface.points.begin() + 100, Point(1000, 1000, 1000));
    for (Triangle& t : surface.triangles)
        for (int& v : t)
            v += v >= 100;
    const EmbedOptions options = options_for(Method::LM, Statistic::Mean);
    embed(surface, test_key(), options);
    EXPECT_EQ(surface.points[100], Point(1000, 1000, 1000));
    EXPECT_EQ(read(surface, options).carrier_of_vertex[100], -1);
    EXPECT_EQ(*read(surface, options).detection_ratio, 1);
}

TEST(Embed, WithBitsZeroTakesWhatTheMessageNeedsAndDetectFindsIt)
{
    Surface surface = load("fandisk.off");
    EmbedOptions options = options_for(Method::LM, Statistic::Mean);
    options.carriers.bits = 0;
    EXPECT_EQ(embed(surface, test_key(), options).carriers, 96); // 48 bits
    const DetectReport alone = detect(surface, test_key(), {options.carriers, {}});
    EXPECT_EQ(alone.message, "museum");
    EXPECT_EQ(alone.carriers, 96);
    EXPECT_EQ(alone.finding, Verdict::Present);
    const DetectReport known = read(surface, options);
    EXPECT_TRUE(*known.present);
    EXPECT_LE(*known.p_value, alone.p_message);
}

// Section 5.6.2: the more the third weight counts, the greater the distortion; (.49, .49, .02) is the thesis' best.
/// By detection's own count of the vertices in each carrier.
TEST(Embed, NamesACapacityAtWhichNoCarrierIsEmpty)
{
    for (const Method method : {Method::Cho, Method::Geodesic})
        for (const char* mesh : {"fandisk.off", "bunny00.off"}) {
            EmbedOptions options = options_for(method, Statistic::Mean);
            options.carriers.bits = 16;
            options.message = read_message("bits:1");
            options.carriers.trim = 0.1;
            const Surface cover = load(mesh);
            Surface stego = cover;
            const int capacity = embed(stego, test_key(), options).capacity;
            EXPECT_GE(capacity, options.carriers.bits);
            const auto poorest = [&](int bits) {
                DetectOptions reading;
                reading.carriers = options.carriers;
                reading.carriers.bits = bits;
                const std::vector<int> held = detect(cover, test_key(), reading).samples;
                return *std::min_element(held.begin(), held.end());
            };
            EXPECT_GT(poorest(capacity), 0) << capacity;
            if (capacity < most_carriers) {
                EXPECT_EQ(poorest(capacity + 1), 0) << capacity;
            }
        }
}

/// What carriers_that_fit() says of raw bits that embed() refuses, and that it is right; 0 where it does not refuse.
int proposed(const char* mesh, Method method, int bits)
{
    EmbedOptions options = options_for(method, Statistic::Mean);
    options.carriers.bits = bits;
    options.message = read_message("bits:" + std::string(bits, '1'));
    Surface surface = load(mesh);
    try {
        embed(surface, test_key(), options);
    } catch (const DoesNotFit& cause) {
        const int fits = carriers_that_fit(surface, test_key(), options, cause);
        options.carriers.bits = fits;
        embed(surface, test_key(), options);
        return fits;
    }
    return 0;
}

TEST(Embed, ProposesMoreBitsWhereFewCannotBeMoved)
{
    int refused = 0;
    for (const int bits : {2, 3, 5, 8})
        if (const int more = proposed("bunny00.off", Method::LM, bits); more > 0) {
            EXPECT_EQ(more, 64) << bits;
            ++refused;
        }
    EXPECT_GT(refused, 0);
}

TEST(Embed, WarnsOfAMarkThatItErases)
{
    const auto warned = [](const EmbedReport& report) {
        return std::any_of(report.warnings.begin(), report.warnings.end(),
                           [](const std::string& text) { return text.find("a mark of this kind") < text.size(); });
    };
    const Surface cover = load("bunny00.off");
    for (const Method first : {Method::LM, Method::Cho, Method::Spectral}) {
        Surface surface = cover;
        EXPECT_FALSE(warned(embed(surface, key_from_text("owner"), options_for(first, Statistic::Mean))));
        EXPECT_FALSE(warned(embed(surface, key_from_text("owner"), options_for(first, Statistic::Mean)))); // the same
        const EmbedReport second = embed(surface, key_from_text("customer"), options_for(Method::LM, Statistic::Mean));
        EXPECT_EQ(warned(second), first != Method::Spectral) << name(first);
    }
}

void append(Surface& surface, const Surface& piece, const Eigen::Affine3d& pose, bool inside_out = false)
{
    const int before = static_cast<int>(surface.points.size());
    for (const Point& p : piece.points)
        surface.points.emplace_back(pose * p);
    for (const auto& [a, b, c] : piece.triangles)
        surface.triangles.push_back(inside_out ? Triangle{before + a, before + c, before + b}
                                               : Triangle{before + a, before + b, before + c});
}

/// What detect() says of a mesh that holds a marked fandisk and other pieces, the marked one the largest.
void expect_found_in_a_piece(Method method, const std::function<void(Surface&, const Surface& marked)>& add)
{
    const EmbedOptions options = options_for(method, Statistic::Mean);
    Surface marked = load("fandisk.off");
    embed(marked, test_key(), options);
    Surface mesh = marked;
    add(mesh, marked);
    const DetectReport found = read(mesh, options);
    EXPECT_EQ(found.finding, Verdict::Present) << found.verdict;
    EXPECT_EQ(found.verdict.substr(0, 9), "part 1 of") << found.verdict;
    ASSERT_FALSE(found.parts.empty());
    EXPECT_LT(*found.parts.front().p_value, 1e-6);
    EXPECT_EQ(*found.p_value, *found.parts.front().p_value);
    EXPECT_EQ(found.pieces, static_cast<int>(found.parts.size()));
    EXPECT_TRUE(found.carrier_of_vertex.empty()); // the piece's vertices are not the mesh's
    if (method == Method::LM) {                   // the others take long where they find nothing
        EXPECT_GT(*read(mesh, options, key_from_text("another")).p_value, 1e-6);
    }
}

TEST(Detect, ReadsACopyOnAPlate)
{
    for (const Method method : {Method::LM, Method::Spectral})
        expect_found_in_a_piece(method, [](Surface& plate, const Surface& marked) {
            const double size = bounding_diagonal(marked);
            for (int k = 1; k < 4; ++k)
                append(plate, marked,
                       Eigen::Translation3d(k * size, 0, 0) * Eigen::AngleAxisd(k, Point(1, 2, 3).normalized()) *
                           Eigen::UniformScaling<double>(1 - 0.1 * k));
        });
}

TEST(Detect, ReadsAHollowedShellAndABodyOnAPedestal)
{
    for (const Method method : {Method::LM, Method::Waves})
        expect_found_in_a_piece(method, [](Surface& mesh, const Surface& marked) {
            const Point middle = bounding_box(marked).center();
            append(mesh, marked,
                   Eigen::Translation3d(middle) * Eigen::UniformScaling<double>(0.8) * Eigen::Translation3d(-middle),
                   true);
            const double size = bounding_diagonal(marked);
            append(mesh, shapes::box(0.3 * size, 0.3 * size, 0.3 * size),
                   Eigen::Affine3d(Eigen::Translation3d(middle - Point(0.1, 0.1, 0.9) * size)));
        });
}

TEST(SphereWeights, KeepTheOrderOfTable52)
{
    const Surface cover = load("bunny00.off");
    double previous = 0;
    for (const std::array<double, 3> weights :
         {std::array<double, 3>{0.49, 0.49, 0.02}, {0.4, 0.4, 0.2}, {0.3, 0.3, 0.4}, {0.5, 0, 0.5}, {0, 0, 1}}) {
        Surface stego = cover;
        EmbedOptions options = options_for(Method::LM, Statistic::Mean);
        options.carriers.trim = 0.1;
        options.placement.sphere.weights = weights;
        const double mrms = embed(stego, test_key(), options).mrms;
        EXPECT_GT(mrms, previous);
        previous = mrms;
    }
}

// methods.md 3 and Table 5.3 with an exact solver: ratios to Cho do not depend on the model's scale.
TEST(Distortion, IsAsPublished)
{
    for (const char* mesh : {"bunny00.off", "fandisk.off"}) {
        const Surface cover = load(mesh);
        for (const Statistic statistic : {Statistic::Mean, Statistic::Variance}) {
            const auto mrms = [&](Method method) {
                Surface stego = cover;
                EmbedOptions options = options_for(method, statistic);
                options.carriers.trim = 0.1;
                return embed(stego, test_key(), options).mrms_relative;
            };
            const double cho = mrms(Method::Cho);
            if (statistic == Statistic::Mean) {
                EXPECT_GT(cho, 2.5e-4);
                EXPECT_LT(cho, 3.3e-4);
            }
            EXPECT_LT(mrms(Method::QSP), 0.45 * cho);
            EXPECT_LT(mrms(Method::LM), (statistic == Statistic::Mean ? 0.17 : 0.19) * cho);
        }
    }
}

/// One key and a message for each customer: nobody is taken for another, by any method.
TEST(Verdict, AnotherMessageIsSaidToBeAnother)
{
    const Surface cover = load("bunny00.off");
    for (const MethodRow& row : all_methods()) {
        SCOPED_TRACE(row.name);
        EmbedOptions options;
        options.carriers.method = row.method;
        options.message = read_message("id:17");
        Surface stego = cover;
        (void)embed(stego, test_key(), options);
        AttackOptions noise;
        noise.attack = Attack::Noise;
        noise.amount = 0.001;
        (void)apply_attack(stego, noise);
        const auto ask = [&](const char* message) {
            return detect(stego, test_key(), {options.carriers, {read_message(message)}});
        };
        EXPECT_EQ(ask("id:17").finding, Verdict::Present);
        for (const char* other : {"id:18", "id:1041", "mark"}) {
            const DetectReport found = ask(other);
            EXPECT_FALSE(*found.present) << other;
            EXPECT_EQ(found.finding, Verdict::AnotherMessage) << other << ": " << found.verdict;
            EXPECT_EQ(found.message, "id:17");
        }
    }
}

} // namespace
