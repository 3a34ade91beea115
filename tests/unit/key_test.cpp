// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/base/error.h"
#include "vcg_ext/key/key.h"
#include "vcg_ext/key/stream.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <numeric>
#include <set>

using namespace vcg_ext;

namespace {

std::vector<std::uint64_t> words(const Key& key, const char* purpose, int count)
{
    Stream stream = key.stream(purpose);
    std::vector<std::uint64_t> drawn(count);
    for (auto& word : drawn)
        word = stream.next();
    return drawn;
}

// From key_vectors.py, which has Argon2id, BLAKE2b and ChaCha20 from elsewhere.
TEST(Key, AgreesWithASecondImplementation)
{
    const auto epsilon = words(Key("correct horse"), "epsilon", 130);
    EXPECT_EQ(epsilon[0], 0xe1e193425e25d42eu);
    EXPECT_EQ(epsilon[1], 0xd75b65bbcc026579u);
    EXPECT_EQ(epsilon[7], 0xc85427f50bc21e56u);
    EXPECT_EQ(epsilon[8], 0xb043af4056d0972du);
    EXPECT_EQ(epsilon[63], 0x791cc28afd863c8cu);
    EXPECT_EQ(epsilon[64], 0xa6cee86cb87cb9du);
    EXPECT_EQ(epsilon[129], 0x57d398e1aa154f9du);

    const auto mask = words(Key("Schl\xc3\xbcssel"), "bit-mask", 130);
    EXPECT_EQ(mask[0], 0xebaafc5c401d2dbeu);
    EXPECT_EQ(mask[64], 0xa09ee95667099d7eu);
    EXPECT_EQ(mask[129], 0xb3dedcc306bab65au);
}

TEST(Stream, DrawsAgreeWithASecondImplementation)
{
    const Key key("correct horse");
    EXPECT_EQ(key.stream("carrier-order").permutation(16),
              (std::vector<int>{8, 13, 4, 6, 3, 7, 10, 14, 0, 12, 1, 2, 11, 15, 9, 5}));

    Stream small = key.stream("epsilon");
    for (const std::uint64_t expected : {9871u, 11818u, 6714u, 7260u})
        EXPECT_EQ(small.below(15001), expected);

    // Half of all values are rejected here.
    Stream large = key.stream("epsilon");
    for (const std::uint64_t expected :
         {579323432036258295u, 2918386893117651049u, 7625164084251856997u, 2893716816446173278u})
        EXPECT_EQ(large.below((std::uint64_t{1} << 63) + 1), expected);
}

TEST(Stream, BelowIsUniform)
{
    Stream stream = Key("uniform").stream("test");
    constexpr int sides = 7;
    constexpr int draws = 70000;
    constexpr double expected = 10000; // draws over sides
    std::array<int, sides> count{};
    for (int i = 0; i < draws; ++i)
        ++count[stream.below(sides)];
    double chi2 = 0;
    for (const int n : count)
        chi2 += (n - expected) * (n - expected) / expected;
    EXPECT_LT(chi2, 22.46); // 6 degrees of freedom, p = 0.001
}

TEST(Stream, PermutationHoldsEveryNumberOnce)
{
    const Key key("permutation");
    for (const int n : {0, 1, 2, 64, 1024}) {
        std::vector<int> order = key.stream("carrier-order").permutation(n);
        std::sort(order.begin(), order.end());
        std::vector<int> all(n);
        std::iota(all.begin(), all.end(), 0);
        EXPECT_EQ(order, all);
    }
}

TEST(Key, PurposesAndPassphrasesAreIndependent)
{
    std::set<std::uint64_t> first;
    for (const char* secret : {"a", "b", "ab"}) {
        const Key key(secret);
        for (const char* purpose : {"epsilon", "carrier-order", "bit-mask", "direction", "trim", "patch-order"})
            first.insert(key.stream(purpose).next());
    }
    EXPECT_EQ(first.size(), 18u);
}

TEST(KeyFromText, ReadsFileAndEnvironment)
{
    const std::string path = testing::TempDir() + "/key_test.secret";
    FILE* file = std::fopen(path.c_str(), "wb");
    ASSERT_NE(file, nullptr);
    std::fputs("correct horse", file);
    std::fclose(file);
    ::setenv("KEY_TEST_SECRET", "correct horse", 1);

    const std::uint64_t expected = key_from_text("correct horse").stream("epsilon").next();
    EXPECT_EQ(key_from_text("file:" + path).stream("epsilon").next(), expected);
    EXPECT_EQ(key_from_text("env:KEY_TEST_SECRET").stream("epsilon").next(), expected);
    const auto from_file = [&](const char* text) {
        std::FILE* other = std::fopen(path.c_str(), "wb");
        std::fputs(text, other);
        std::fclose(other);
        return key_from_text("file:" + path).stream("epsilon").next();
    };
    EXPECT_EQ(from_file("correct horse\n"), expected); // as editors end a line
    EXPECT_EQ(from_file("correct horse\r\n"), expected);
    EXPECT_NE(from_file("correct horse\n\n"), expected);
    std::remove(path.c_str());
}

TEST(KeyFromText, RefusesWhatIsEmptyOrMissing)
{
    EXPECT_THROW((void)key_from_text(""), Error);
    EXPECT_THROW((void)key_from_text("file:/no/such/file"), Error);
    EXPECT_THROW((void)key_from_text("file:/dev/null"), Error);
    try {
        (void)key_from_text("file:" + testing::TempDir());
        FAIL() << "took a folder";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("cannot be read"), std::string::npos) << error.what();
    }
    EXPECT_THROW((void)key_from_text("env:KEY_TEST_NO_SUCH_VARIABLE"), Error);
}

} // namespace
