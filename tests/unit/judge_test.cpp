// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/watermark/judge.h"

#include "vcg_ext/base/error.h"
#include "vcg_ext/key/random.h"
#include "vcg_ext/payload/code.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace vcg_ext;

namespace {

double noise(Stream& stream)
{
    double sum = -2;
    for (int i = 0; i < 4; ++i)
        sum += uniform(stream);
    return sum * std::sqrt(3.0);
}

/// Soft values of a marked mesh: the word's signs and noise.
std::vector<double> noisy(const Bits& word, double deviation, Stream& stream)
{
    std::vector<double> soft;
    for (const std::uint8_t bit : word)
        soft.push_back((bit ? 1 : -1) + deviation * noise(stream));
    return soft;
}

/// Soft values of an unmarked mesh: coins with the magnitudes that carriers have.
std::vector<double> unmarked(int carriers, Stream& stream)
{
    std::vector<double> soft;
    for (int k = 0; k < carriers; ++k)
        soft.push_back((stream.below(2) ? 1 : -1) * std::abs(noise(stream)));
    return soft;
}

/// What is made of these soft values, the mask lifted already.
Judgement judged(const std::vector<double>& soft, const std::vector<Message>& expected = {})
{
    LayerReading layer{Method::LM, {}, Bits(soft.size(), 0)};
    layer.readings.ways.emplace_back();
    layer.readings.ways.back().soft = soft;
    return judge({layer}, static_cast<int>(soft.size()), expected);
}

double expected_log_p(const Message& message, const std::vector<double>& soft)
{
    return judged(soft, {message}).match->log10_p;
}

TEST(Judge, TheKeyAloneFindsMessageLengthAndKind)
{
    Stream stream = seeded_stream(1, "judge-test");
    for (const char* text : {"id:4711", "a", "abc", "abcd", "(c) Jane", "customer 0017", "hex:00ff00ff00"})
        for (const int more : {1, 2}) {
            const Message message = read_message(text);
            const int carriers = more * recommended_carriers(message);
            const Judgement::Read found = judged(noisy(encode(message, carriers), 0.35, stream)).best;
            EXPECT_EQ(show_message(found.bits, found.kind), text) << carriers;
            EXPECT_LT(found.log10_p, -6) << text << " in " << carriers;
        }
}

TEST(Judge, TwoLayersProveNoMessageThatIsNotTheirs)
{
    // Words that the key alone does not look for: 48 bits in 64 carriers, and raw ones. One of 40 bits is near.
    constexpr int carriers = 64;
    Stream stream = seeded_stream(5, "judge-test");
    const Bits mask(carriers, 0);
    for (const char* text : {"museum", "castle", "bits:0110", "hex:0123456789ab"}) {
        const Message message = read_message(text);
        std::vector<LayerReading> layers;
        for (const Method method : {Method::LM, Method::Geodesic}) {
            layers.push_back({method, {}, mask});
            std::vector<double>& soft = layers.back().readings.ways.emplace_back().soft;
            for (const double s : noisy(encode(message, carriers), 0.2, stream))
                soft.push_back(6 * s);
        }
        const Judgement judgement = judge(layers, carriers, {message});
        EXPECT_GT(judgement.best.log10_p, -6) << text;
        EXPECT_LT(judgement.match->log10_p, -18) << text;
        layers.pop_back();
        EXPECT_GT(judge(layers, carriers, {message}).best.log10_p, -6) << text;
    }
}

TEST(Judge, SixteenBitsProveNothing)
{
    Stream stream = seeded_stream(2, "judge-test");
    EXPECT_GT(judged(noisy(encode(read_message("ab"), 32), 0, stream)).best.log10_p, -6);
    EXPECT_EQ(judged(std::vector<double>(27, 1.0)).best.log10_p, 0);
}

TEST(Judge, AnotherCustomerIsNotAccused)
{
    Stream stream = seeded_stream(3, "judge-test");
    const std::vector<double> soft = noisy(encode(read_message("customer 0017"), 256), 0.7, stream);
    EXPECT_LT(expected_log_p(read_message("customer 0017"), soft), -30);
    for (const char* other : {"customer 0018", "customer 0016", "0815", "customer"})
        EXPECT_GT(expected_log_p(read_message(other), soft), -4) << other;
}

TEST(Judge, ClaimsHoldOnUnmarkedMeshes)
{
    Stream stream = seeded_stream(4, "judge-test");
    constexpr int meshes = 500;
    const Message expected = read_message("id:17");
    const std::vector<Message> list = read_candidates("id:1\nid:2\nid:3\nid:4\nid:5\nid:6\nid:7\nid:8\n");
    int any[3] = {};
    int named[3] = {};
    int listed[3] = {};
    for (int mesh = 0; mesh < meshes; ++mesh) {
        const std::vector<double> soft = unmarked(64, stream);
        const double p[3] = {judged(soft).best.log10_p, expected_log_p(expected, soft),
                             judged(soft, list).match->log10_p};
        for (int digits = 1; digits <= 2; ++digits) {
            any[digits] += p[0] <= -digits;
            named[digits] += p[1] <= -digits;
            listed[digits] += p[2] <= -digits;
        }
        EXPECT_GT(p[0], -6);
    }
    for (int digits = 1; digits <= 2; ++digits) {
        const double nominal = meshes * std::pow(10, -digits);
        const double most = nominal + 3 * std::sqrt(nominal);
        EXPECT_LE(any[digits], most);
        EXPECT_LE(named[digits], most);
        EXPECT_LE(listed[digits], most);
        EXPECT_GE(named[digits], nominal - 4 * std::sqrt(nominal)) << "a weak bound";
    }
}

TEST(Judge, BesideTheMessageThatIsThereAnotherReadsAsOftenAsItClaims)
{
    // Both layers carry one recipient's message; those of the others are drawn at random, as a ledger does.
    Stream stream = seeded_stream(7, "judge-test");
    const auto drawn = [&stream] { return read_message("id:" + std::to_string(stream.below(std::uint64_t{1} << 32))); };
    constexpr int carriers = 64;
    constexpr int files = 200;
    int second[3] = {};
    int innocent[3] = {};
    int asked_alone[3] = {};
    constexpr int alone_of_file = 4;
    for (int file = 0; file < files; ++file) {
        std::vector<Message> list;
        while (list.size() < 9)
            list.push_back(drawn());
        const std::size_t place = file % list.size();
        const Message there = list[place];
        std::vector<LayerReading> layers;
        for (const Method method : {Method::LM, Method::Geodesic}) {
            layers.push_back({method, {}, Bits(carriers, 0)});
            std::vector<double>& soft = layers.back().readings.ways.emplace_back().soft;
            for (const double value : noisy(encode(there, carriers), 0.3, stream))
                soft.push_back(6 * value);
        }
        const double runner_up = judge(layers, carriers, list).match->runner_up;
        list.erase(list.begin() + static_cast<std::ptrdiff_t>(place));
        const double best = judge(layers, carriers, list).match->log10_p;
        for (int i = 0; i < alone_of_file; ++i) {
            const double alone = judge(layers, carriers, {list[i]}).match->log10_p;
            for (int digits = 1; digits <= 2; ++digits)
                asked_alone[digits] += alone <= -digits;
        }
        for (int digits = 1; digits <= 2; ++digits) {
            second[digits] += runner_up <= -digits;
            innocent[digits] += best <= -digits;
        }
    }
    for (int digits = 1; digits <= 2; ++digits) {
        const double nominal = files * std::pow(10, -digits);
        EXPECT_LE(second[digits], nominal + 3 * std::sqrt(nominal)) << digits;
        EXPECT_LE(innocent[digits], nominal + 3 * std::sqrt(nominal)) << digits;
        const double of_all = alone_of_file * nominal;
        EXPECT_LE(asked_alone[digits], of_all + 3 * std::sqrt(of_all)) << digits;
    }
}

TEST(Judge, ALayerByItselfSaysAmongOthersWhatItSaysAlone)
{
    Stream stream = seeded_stream(8, "judge-test");
    const Message expected = read_message("id:17");
    const Bits word = encode(expected, 64);
    for (const double deviation : {0.3, 0.8, 1.5, 2.0, 4.0, 1e9}) {
        std::vector<LayerReading> layers;
        for (const Method method : {Method::Waves, Method::Spectral, Method::LM}) {
            layers.push_back({method, {}, Bits(64, 0)});
            layers.back().readings.ways.emplace_back().soft =
                deviation < 1e9 ? noisy(word, deviation, stream) : std::vector<double>(64, 0);
        }
        const Judgement together = judge(layers, 64, {expected});
        for (std::size_t i = 0; i < layers.size(); ++i) {
            const Judgement alone = judge({layers[i]}, 64, {expected});
            EXPECT_NEAR(together.of_layer[i].log10_p, alone.best.log10_p, 1e-9) << deviation;
            EXPECT_NEAR(together.match_of_layer[i], alone.match->log10_p, 1e-9) << deviation;
        }
    }
}

TEST(Judge, TheCandidateIsFound)
{
    Stream stream = seeded_stream(5, "judge-test");
    std::string lines;
    for (int i = 0; i < 100'000; ++i)
        lines += "id:" + std::to_string(i) + "\n";
    lines += "id:4711\ncustomer 0017\n"; // one again, and one too long
    const std::vector<Message> list = read_candidates(lines);
    const std::vector<double> soft = noisy(encode(read_message("id:4711"), 64), 0.7, stream);
    const Judgement::Match match = *judged(soft, list).match;
    EXPECT_EQ(match.candidate, 4711u);
    EXPECT_LT(match.log10_p, -6);
    EXPECT_GT(match.runner_up, -2) << "the same line again is no runner-up";
    const double alone = expected_log_p(list[4711], soft);
    EXPECT_GE(match.log10_p, alone + std::log10(100'002.0) - 1e-9) << "lines that cannot be meant count too";
    EXPECT_LT(match.log10_p, alone + std::log10(100'002.0) + 1);
}

TEST(Judge, TheLayerWhoseMatchConvincesIsTheViewThatIsShown)
{
    Stream stream = seeded_stream(6, "judge-test");
    Message raw = read_message("hex:0123456789abcdef");
    raw.kind = Kind::Bits;
    for (const int marked : {0, 1}) {
        std::vector<LayerReading> layers(2, {Method::Waves, {}, Bits(64, 0)});
        for (int layer : {0, 1}) {
            layers[layer].readings.ways.resize(1);
            layers[layer].readings.ways[0].soft = layer == marked ? noisy(raw.bits, 0.2, stream) : unmarked(64, stream);
        }
        layers[marked].readings.match = [](const Bits&) { return -40.0; };
        const Judgement judgement = judge(layers, 64, {raw});
        const Judgement::View& view = judgement.views[judgement.view];
        EXPECT_EQ(view.layer, marked);
        EXPECT_EQ(view.soft, layers[marked].readings.ways[0].soft);
    }
}

TEST(Judge, ListsThatDoNotFitWhole)
{
    const std::vector<double> soft(30, 1.0);
    const Judgement::Match one = *judged(soft, read_candidates("customer 0017\nbits:1111\nid:3\n")).match;
    EXPECT_GT(one.candidate, 0u);
    const std::vector<double> blank(64, 0.0);
    const Judgement::Match none = *judged(blank, read_candidates("id:3\nid:3\n")).match;
    EXPECT_EQ(none.log10_p, 0);
    EXPECT_EQ(none.runner_up, 0);
}

} // namespace
