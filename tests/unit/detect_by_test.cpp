// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/watermark/detect.h"

#include "vcg_ext/key/random.h"
#include "vcg_ext/payload/binomial.h"
#include "vcg_ext/payload/code.h"
#include "vcg_ext/watermark/secrets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace vcg_ext;

namespace {

constexpr int carriers = 64;

const Key& key()
{
    static const Key one("detect-by");
    return one;
}

DetectOptions asking(const std::vector<std::string>& expected, Method method = Method::LM)
{
    DetectOptions options;
    options.carriers.method = method;
    options.carriers.bits = carriers;
    for (const std::string& text : expected)
        options.expected.push_back(read_message(text));
    return options;
}

/// A surface whose carriers say this message, but for the last ones, which are wrong, or erased before them.
LayerReader saying(const std::string& message, int wrong, int erased = 0, std::optional<double> presence = {})
{
    return [=](const MethodRow& method, const Plan& plan) {
        const Bits mask = bit_mask(key(), method.secret, plan.options.bits);
        const Bits coded = masked(encode(read_message(message), plan.options.bits), mask);
        Readings readings;
        std::vector<double>& soft = readings.ways.emplace_back().soft;
        for (int k = 0; k < carriers; ++k) {
            const double right = coded[k] ? 1 : -1;
            soft.push_back(k >= carriers - wrong ? -right : k >= carriers - wrong - erased ? 0 : right);
        }
        readings.presence = presence;
        return readings;
    };
}

DetectReport found(const LayerReader& reader, const DetectOptions& options, double share = 1)
{
    return detect_by(reader, {}, share, key(), options);
}

TEST(DetectBy, TakesItsShareOffEveryProbability)
{
    const LayerReader reader = saying("id:4711", 8, 0, -12);
    for (const DetectOptions& options :
         {asking({}), asking({"id:4711"}), asking({"id:4711", "id:4712", "id:11"}), asking({"bits:0110"})}) {
        const DetectReport whole = found(reader, options);
        const DetectReport piece = found(reader, options, 1.0 / 64);
        const auto expect = [](std::optional<double> some, std::optional<double> all) {
            ASSERT_EQ(some.has_value(), all.has_value());
            EXPECT_NEAR(std::log(some.value_or(1)), std::log(std::min(1.0, 64 * all.value_or(1))), 1e-9);
        };
        expect(piece.p_message, whole.p_message);
        expect(piece.p_value, whole.p_value);
        expect(piece.p_binomial, whole.p_binomial);
        expect(piece.runner_up_p, whole.runner_up_p);
        expect(piece.presence, whole.presence);
        expect(piece.layers.front().p_message, whole.layers.front().p_message);
        expect(piece.layers.front().p_value, whole.layers.front().p_value);
        expect(piece.layers.front().presence, whole.layers.front().presence);
    }
}

TEST(DetectBy, SaysByTheSharedProbabilityThatAMarkIsThere)
{
    const LayerReader reader = saying("id:4711", 32, 0, -7);
    const DetectReport sure = found(reader, asking({"id:4711"}));
    EXPECT_EQ(sure.finding, Verdict::NoMessage);
    EXPECT_NE(sure.verdict.find("p 1e-7"), std::string::npos) << sure.verdict;
    EXPECT_EQ(found(reader, asking({"id:4711"}), 1.0 / 64).finding, Verdict::NotFound);
}

TEST(DetectBy, OfTheNumbersOfCarriersTakesTheOneThatAMarkIsIn)
{
    // In 64 a mark is there whose message is lost; by 96, of which a third is wrong, the message is a little likely.
    const LayerReader marked = saying("id:4711", 32, 0, -20);
    const LayerReader reader = [&](const MethodRow& method, const Plan& plan) {
        const int count = plan.options.bits;
        if (count == carriers)
            return marked(method, plan);
        const Bits coded = masked(encode(read_message("id:4711"), count), bit_mask(key(), method.secret, count));
        Readings readings;
        std::vector<double>& soft = readings.ways.emplace_back().soft;
        Stream stream = seeded_stream(count, "detect-by-test");
        for (int k = 0; k < count; ++k)
            soft.push_back((coded[k] ? 1 : -1) * (stream.below(count == 96 ? 3 : 2) == 0 ? -1 : 1));
        return readings;
    };
    DetectOptions options = asking({"id:4711"});
    options.carriers.bits = 0;
    const DetectReport report = found(reader, options);
    EXPECT_EQ(report.finding, Verdict::NoMessage) << report.verdict;
    EXPECT_EQ(report.carriers, carriers);
    EXPECT_LT(report.presence.value_or(1), 1e-18);
    EXPECT_LT(*report.p_value, 0.1); // of any number
}

TEST(DetectBy, AnErasedCarrierIsNoMatch)
{
    // 24 erased; all that are read are right, then all but eight. The message is of zeros, as the hard bits of erased
    // carriers are.
    const std::string zeros = "bits:" + std::string(carriers, '0');
    const DetectReport right = found(saying(zeros, 0, 24), asking({zeros}));
    EXPECT_DOUBLE_EQ(*right.detection_ratio, (40 + 12) / 64.0);
    EXPECT_DOUBLE_EQ(*right.p_binomial, binomial_tail(40, 40));
    const DetectReport nearly = found(saying(zeros, 8, 24), asking({zeros}));
    EXPECT_DOUBLE_EQ(*nearly.detection_ratio, (32 + 12) / 64.0);
    EXPECT_DOUBLE_EQ(*nearly.p_binomial, binomial_tail(40, 32));
    const DetectReport nothing = found(saying(zeros, 0, carriers), asking({zeros}));
    EXPECT_EQ(*nothing.p_binomial, 1);
    EXPECT_EQ(*nothing.detection_ratio, 0.5);
}

DetectReport report(Verdict finding, double p_message, std::optional<double> p_value = {})
{
    DetectReport result;
    result.finding = finding;
    result.p_message = p_message;
    result.p_value = p_value;
    return result;
}

TEST(SaysMore, GoesByWhatIsFoundAndThenByTheProbability)
{
    const std::vector<DetectReport> rising = {
        report(Verdict::NotFound, 1),         report(Verdict::NotFound, 0.7), report(Verdict::NotFound, 1, 1e-3),
        report(Verdict::AnotherKey, 1),       report(Verdict::NoMessage, 1),  report(Verdict::AnotherMessage, 1e-19, 1),
        report(Verdict::Present, 1e-3, 1e-7), report(Verdict::Present, 1e-9)};
    for (std::size_t a = 0; a < rising.size(); ++a)
        for (std::size_t b = 0; b < rising.size(); ++b)
            EXPECT_EQ(says_more(rising[a], rising[b]), a > b) << a << " " << b;
}

} // namespace
