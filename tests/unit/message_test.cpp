// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/base/error.h"
#include "vcg_ext/payload/message.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

TEST(ParseMessage, PlainHexAndBits)
{
    EXPECT_EQ(parse_message("A"), (Bits{0, 1, 0, 0, 0, 0, 0, 1}));
    EXPECT_EQ(parse_message("hex:41"), parse_message("A"));
    EXPECT_EQ(parse_message("hex:aF"), (Bits{1, 0, 1, 0, 1, 1, 1, 1}));
    EXPECT_EQ(parse_message("bits:0110"), (Bits{0, 1, 1, 0}));
}

TEST(ParseMessage, RefusesNonsense)
{
    for (const char* text : {"", "hex:", "bits:", "hex:4g", "bits:012", "hex: 41"})
        EXPECT_THROW((void)parse_message(text), Error) << text;
}

TEST(PadMessage, FillsWithZerosAndRefusesWhatIsTooLong)
{
    EXPECT_EQ(pad_message({1, 1}, 4), (Bits{1, 1, 0, 0}));
    EXPECT_EQ(pad_message({1, 1}, 2), (Bits{1, 1}));
    EXPECT_THROW((void)pad_message({1, 1, 1}, 2), Error);
    EXPECT_THROW((void)pad_message(parse_message("12345678"), 32), Error);
    EXPECT_EQ(pad_message(parse_message("hex:ffc"), 10), Bits(10, 1));
    EXPECT_THROW((void)pad_message(parse_message("hex:ffe"), 10), Error);
    EXPECT_THROW((void)pad_message(Bits(8, 0), 4), Error);
}

TEST(FormatMessage, IsTextOnlyWherePrintable)
{
    const auto padded = [](const char* text, int bits) {
        return format_message(pad_message(parse_message(text), bits));
    };
    EXPECT_EQ(padded("museum", 64), "museum");
    EXPECT_EQ(padded("M\xc3\xbcller", 64), "M\xc3\xbcller");
    EXPECT_EQ(padded("\xe2\x82\xac 5 \xf0\x9f\x97\xbf", 96), "\xe2\x82\xac 5 \xf0\x9f\x97\xbf");
    EXPECT_EQ(padded("hex:00", 8), "hex:00");
    EXPECT_EQ(padded("hex:4100ff", 24), "hex:4100ff");
    EXPECT_EQ(padded("hex:0a", 8), "hex:0a");          // a control character
    EXPECT_EQ(padded("hex:c280", 16), "hex:c280");     // a C1 control character
    EXPECT_EQ(padded("hex:c0af", 16), "hex:c0af");     // overlong
    EXPECT_EQ(padded("hex:eda080", 24), "hex:eda080"); // a surrogate
    EXPECT_EQ(padded("hex:e282", 16), "hex:e282");     // cut off
    EXPECT_EQ(padded("bits:1010101", 7), "hex:aa");
}

TEST(FormatMessage, ReadsBackToTheSameBits)
{
    std::uint32_t state = 1; // a linear congruence: any spread of bits will do
    for (int length = 1; length <= 200; ++length) {
        Bits bits(length);
        for (auto& bit : bits) {
            state = state * 1664525u + 1013904223u;
            bit = state >> 31;
        }
        EXPECT_EQ(pad_message(parse_message(format_message(bits)), length), bits);
    }
    // Texts that would read as another notation are written in hex.
    for (const char* text : {"hex:41", "bits:01"}) {
        Bits bits;
        for (const char* c = text; *c; ++c)
            for (int b = 7; b >= 0; --b)
                bits.push_back(*c >> b & 1);
        EXPECT_EQ(parse_message(format_message(bits)), bits);
    }
}

} // namespace
