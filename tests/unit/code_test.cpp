// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/payload/code.h"

#include "vcg_ext/base/error.h"
#include "vcg_ext/key/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

using namespace vcg_ext;

namespace {

Bits drawn(Stream& stream, int bits)
{
    Bits message;
    for (int i = 0; i < bits; ++i)
        message.push_back(static_cast<std::uint8_t>(stream.below(2)));
    return message;
}

std::vector<double> clean(const Bits& word)
{
    std::vector<double> soft;
    for (const std::uint8_t bit : word)
        soft.push_back(bit ? 1 : -1);
    return soft;
}

double part_that_differs(const Bits& a, const Bits& b)
{
    double count = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
        count += a[k] != b[k];
    return count / static_cast<double>(a.size());
}

std::string error_of(const std::string& text, int carriers)
{
    try {
        (void)encode(read_message(text), carriers);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Code, EveryLengthReadsBack)
{
    Stream stream = seeded_stream(1, "code-test");
    for (const int carriers : {1, 2, 7, 20, 64, 65, 96, 128, 250, 384, 512, 1024})
        for (const int bits : {1, 2, 8, 13, 32, carriers / 3, carriers / 2, carriers})
            for (const Kind kind : {Kind::Text, Kind::Id}) {
                if (bits < 1 || bits > carriers)
                    continue;
                const Code code(bits, carriers, kind);
                const Bits message = drawn(stream, bits);
                const Bits word = code.encode(message);
                EXPECT_EQ(code.decode(clean(word), 2), message) << bits << " in " << carriers;
            }
}

TEST(Code, MessagesArePaddedAndReadBack)
{
    for (const char* text : {"id:4711", "abc", "hex:C0F", "customer 0017", "(c) Jane"}) {
        const Message message = read_message(text);
        const int carriers = recommended_carriers(message);
        const int bits = static_cast<int>(message.bits.size());
        const Bits found = decode(clean(encode(message, carriers)), bits, message.kind);
        EXPECT_EQ(found, pad_message(message.bits, coded_length(bits, carriers)));
        EXPECT_EQ(read_message(show_message(found, message.kind)).bits.size() >= message.bits.size(), true);
    }
    const Message raw = read_message("bits:0110");
    EXPECT_EQ(encode(raw, 6), (Bits{0, 1, 1, 0, 0, 0}));
    EXPECT_EQ(decode({-1, 2, 3, -4, 0, -1}, 6, Kind::Bits), (Bits{0, 1, 1, 0, 0, 0}));
}

TEST(Code, OneBitMoreOrLessChangesHalfOfTheCarriers)
{
    Stream stream = seeded_stream(2, "code-test");
    int pairs = 0;
    for (const int carriers : {64, 96, 128, 256, 512, 1024})
        for (const int bits : {8, 16, 24, 32, carriers / 2}) {
            const Code code(bits, carriers, Kind::Text);
            const Bits message = drawn(stream, bits);
            const Bits word = code.encode(message);
            for (int i = 0; i < bits; ++i, ++pairs) {
                Bits other = message;
                other[i] ^= 1;
                const double part = part_that_differs(word, code.encode(other));
                EXPECT_GE(part, 0.4) << bits << " in " << carriers;
                EXPECT_LE(part, 0.6) << bits << " in " << carriers;
            }
        }
    EXPECT_GT(pairs, 1000);
}

TEST(Code, LikeMessagesAreAsFarApartAsAnyTwo)
{
    double sum = 0;
    int count = 0;
    for (const int carriers : {256, 384}) {
        const Bits word = encode(read_message("customer 0017"), carriers);
        for (const char* other :
             {"customer 0018", "customer 0016", "customer 0117", "Customer 0017", "customer 001", "customer", "0815"}) {
            const double part = part_that_differs(word, encode(read_message(other), carriers));
            EXPECT_NEAR(part, 0.5, 0.14) << other; // 4.5 standard deviations
            sum += part;
            ++count;
        }
    }
    EXPECT_NEAR(sum / count, 0.5, 0.03);
}

TEST(Code, LengthsAndKindsHaveCodesOfTheirOwn)
{
    const Bits id = encode(read_message("id:1633837924"), 64); // the number of the bytes "abcd"
    const Bits text = encode(read_message("abcd"), 64);
    EXPECT_NEAR(part_that_differs(id, text), 0.5, 0.2);
    EXPECT_NEAR(part_that_differs(encode(read_message("abc"), 64), encode(read_message("hex:61626300"), 64)), 0.5, 0.2);
    EXPECT_EQ(text, encode(read_message("hex:61626364"), 64));
}

TEST(Code, PaddedLengths)
{
    EXPECT_EQ(coded_length(1, 64), 8);
    EXPECT_EQ(coded_length(32, 64), 32);
    EXPECT_EQ(coded_length(33, 96), 40);
    EXPECT_EQ(coded_length(60, 62), 62);
    EXPECT_EQ(coded_length(128, 256), 128);
    EXPECT_EQ(coded_length(129, 384), 144);
    EXPECT_EQ(coded_length(257, 1024), 288);
    EXPECT_EQ(coded_length(513, 1024), 576);
    for (int bits = 1; bits <= 512; ++bits) { // a padded message is among what the detector tries
        const int carriers = recommended_carriers({Kind::Hex, Bits(bits), ""});
        EXPECT_LE(2 * coded_length(bits, carriers), carriers) << bits;
        const auto ways = hypotheses(carriers);
        EXPECT_TRUE(std::any_of(ways.begin(), ways.end(), [&](const Hypothesis& way) {
            return way.bits == coded_length(bits, carriers);
        })) << bits;
    }
}

TEST(Code, RecommendedCarriers)
{
    EXPECT_EQ(recommended_carriers(read_message("id:4294967295")), 64);
    EXPECT_EQ(recommended_carriers(read_message("abcd")), 64);
    EXPECT_EQ(recommended_carriers(read_message("abcde")), 96);
    EXPECT_EQ(recommended_carriers(read_message("(c) Jane")), 128);
    EXPECT_EQ(recommended_carriers(read_message("customer 0017")), 256);
    EXPECT_EQ(recommended_carriers(read_message(std::string(64, 'x'))), 1024);
    EXPECT_EQ(recommended_carriers(read_message("bits:" + std::string(100, '1'))), 128);
    EXPECT_THROW((void)recommended_carriers(read_message(std::string(65, 'x'))), Error);
}

TEST(Code, WeightsSumToOne)
{
    for (int carriers = 1; carriers <= 1024; ++carriers) {
        double sum = 0;
        for (const Hypothesis& way : hypotheses(carriers)) {
            EXPECT_GT(way.weight, 0);
            EXPECT_LE(way.bits + 20, carriers);
            sum += way.weight;
        }
        EXPECT_NEAR(sum, carriers >= 28 ? 1 : 0, 1e-12) << carriers;
    }
    EXPECT_EQ(hypotheses(64).front().bits, 32);
    EXPECT_EQ(hypotheses(64).size(), 6u); // 32 twice, 24, 40, 16, 8
}

TEST(Code, WhatTheKeyAloneCanProve)
{
    EXPECT_LT(clean_log_p(read_message("id:1"), 64), -6);
    EXPECT_LT(clean_log_p(read_message("abcde"), 64), -6);
    EXPECT_EQ(clean_log_p(read_message("abcdef"), 64), 0); // 48 bits and 20 are more than 64
    EXPECT_GT(clean_log_p(read_message("ab"), 32), -6);
    EXPECT_EQ(clean_log_p(read_message("bits:0110"), 64), 0);
}

// The words are part of the format: these are of its first version.
TEST(Code, FormatIsPinned)
{
    const auto hex = [](const char* text, int carriers) {
        const Bits word = encode(read_message(text), carriers);
        return format_message(Bits(word.begin(), word.begin() + 64));
    };
    EXPECT_EQ(hex("id:17", 64), "hex:42c15124d458c0cf");
    EXPECT_EQ(hex("abc", 64), "hex:81108576f88aed8e");
    EXPECT_EQ(hex("(c) Jane", 128), "hex:51865609f034085a");
    EXPECT_EQ(hex("customer 0017", 256), "hex:802085372b5a655e");
    EXPECT_EQ(hex("hex:0123456789abcdef", 192), "hex:6fa95e8728ba1919");
}

TEST(Code, SaysWhatDoesNotFit)
{
    EXPECT_NE(error_of("customer 0017", 64).find("13 letters need 104 bits"), std::string::npos);
    EXPECT_NE(error_of("id:17", 31).find("an id needs 32 bits"), std::string::npos);
    EXPECT_THROW((void)Code(8, 16, Kind::Text).encode(Bits(9, 0)), Error);
    EXPECT_THROW((void)Code(17, 16, Kind::Text), Error);
}

} // namespace
