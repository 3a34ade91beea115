// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/payload/find.h"

#include "vcg_ext/base/error.h"
#include "vcg_ext/key/random.h"
#include "vcg_ext/payload/code.h"

#include <gtest/gtest.h>

#include <chrono>
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

TEST(Find, TheKeyAloneFindsMessageLengthAndKind)
{
    Stream stream = seeded_stream(1, "find-test");
    for (const char* text : {"id:4711", "a", "abc", "abcd", "(c) Jane", "customer 0017", "hex:00ff00ff00"})
        for (const int more : {1, 2}) {
            const Message message = read_message(text);
            const int carriers = more * recommended_carriers(message);
            const auto found = find_message(noisy(encode(message, carriers), 0.35, stream));
            ASSERT_TRUE(found);
            EXPECT_EQ(show_message(found->bits, found->kind), text) << carriers;
            EXPECT_TRUE(says(*found, message, carriers));
            EXPECT_FALSE(says(*found, read_message("another"), carriers));
            EXPECT_LT(found->log10_any, -6) << text << " in " << carriers;
            EXPECT_LE(found->log10_p, found->log10_any);
        }
}

TEST(Find, SixteenBitsProveNothing)
{
    Stream stream = seeded_stream(2, "find-test");
    const auto found = find_message(noisy(encode(read_message("ab"), 32), 0, stream));
    ASSERT_TRUE(found);
    EXPECT_GT(found->log10_any, -6);
    EXPECT_FALSE(find_message(std::vector<double>(27, 1.0)));
}

TEST(Find, AnotherCustomerIsNotAccused)
{
    Stream stream = seeded_stream(3, "find-test");
    const std::vector<double> soft = noisy(encode(read_message("customer 0017"), 256), 0.7, stream);
    EXPECT_LT(expected_log_p(read_message("customer 0017"), soft), -30);
    for (const char* other : {"customer 0018", "customer 0016", "0815", "customer"})
        EXPECT_GT(expected_log_p(read_message(other), soft), -4) << other;
    EXPECT_THROW((void)expected_log_p(read_message("abc"), {1, 2, 3}), Error);
}

TEST(Find, ClaimsHoldOnUnmarkedMeshes)
{
    Stream stream = seeded_stream(4, "find-test");
    constexpr int meshes = 500;
    const Message expected = read_message("id:17");
    const std::vector<Message> list = read_candidates("id:1\nid:2\nid:3\nid:4\nid:5\nid:6\nid:7\nid:8\n");
    int any[3] = {};
    int named[3] = {};
    int listed[3] = {};
    for (int mesh = 0; mesh < meshes; ++mesh) {
        const std::vector<double> soft = unmarked(64, stream);
        const double p[3] = {find_message(soft, 8)->log10_any, expected_log_p(expected, soft),
                             rank_candidates(list, soft).log10_p};
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

TEST(Find, TheCandidateIsFound)
{
    Stream stream = seeded_stream(5, "find-test");
    std::string lines;
    for (int i = 0; i < 100'000; ++i)
        lines += "id:" + std::to_string(i) + "\n";
    lines += "id:4711\ncustomer 0017\n"; // one again, and one too long
    const std::vector<Message> list = read_candidates(lines);
    const std::vector<double> soft = noisy(encode(read_message("id:4711"), 64), 0.7, stream);
    const auto start = std::chrono::steady_clock::now();
    const Ranking ranking = rank_candidates(list, soft);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(ranking.best, 4711);
    EXPECT_LT(ranking.log10_p, -6);
    EXPECT_GE(ranking.runner_up, 0);
    EXPECT_NE(ranking.runner_up, 100'000) << "the same line again is no runner-up";
    EXPECT_GT(ranking.runner_up_log10_p, -2);
    EXPECT_NEAR(ranking.log10_p, expected_log_p(list[4711], soft) + std::log10(100'002.0), 1e-9);
    EXPECT_LT(seconds.count(), 1);
}

TEST(Find, ListsThatDoNotFit)
{
    const Ranking none = rank_candidates(read_candidates("customer 0017\n"), std::vector<double>(64, 1.0));
    EXPECT_EQ(none.best, -1);
    EXPECT_EQ(none.log10_p, 0);
    const Ranking one = rank_candidates(read_candidates("id:3\nid:3\nhex:00\nbits:1\n"), std::vector<double>(30, 1.0));
    EXPECT_GE(one.best, 0);
    EXPECT_GE(one.runner_up, 0);
    const Ranking alone = rank_candidates(read_candidates("id:3\nid:3\n"), std::vector<double>(64, 0.0));
    EXPECT_EQ(alone.best, 0);
    EXPECT_EQ(alone.runner_up, -1);
    EXPECT_EQ(alone.log10_p, 0);
}

} // namespace
