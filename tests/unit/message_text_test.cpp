// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/payload/message_text.h"

#include "vcg_ext/base/error.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

TEST(MessageText, KindsOfMessages)
{
    const Message id = read_message("id:17");
    EXPECT_EQ(id.kind, Kind::Id);
    EXPECT_EQ(bit_string(id.bits), std::string(27, '0') + "10001");
    EXPECT_EQ(id.text, "id:17");
    EXPECT_EQ(bit_string(read_message("id:4294967295").bits), std::string(32, '1'));
    EXPECT_EQ(read_message("hex:C0F").kind, Kind::Hex);
    EXPECT_EQ(read_message("hex:C0F").bits.size(), 12u);
    EXPECT_EQ(read_message("bits:01").kind, Kind::Bits);
    EXPECT_EQ(read_message("Id:17").kind, Kind::Text);
    EXPECT_EQ(read_message("A").bits, read_message("hex:41").bits);
}

TEST(MessageText, RefusesWhatIsNoId)
{
    for (const char* text : {"id:", "id:-1", "id: 1", "id:1 ", "id:4294967296", "id:1.5", "id:0x10", "id:seven"})
        EXPECT_THROW((void)read_message(text), Error) << text;
    EXPECT_THROW((void)read_message(""), Error);
    EXPECT_THROW((void)read_message("hex:5G"), Error);
    EXPECT_THROW((void)read_message("bits:012"), Error);
    EXPECT_THROW((void)read_message("file:messages.txt"), Error);
}

TEST(MessageText, ShownAsItWasWritten)
{
    for (const char* text : {"id:0", "id:4294967295", "customer 0017", "Zo\xC3\xAB", "bits:0110", "hex:00ff"}) {
        const Message message = read_message(text);
        EXPECT_EQ(show_message(message.bits, message.kind), text);
    }
    EXPECT_EQ(show_message(read_message("hex:41424344").bits, Kind::Hex), "ABCD");
    EXPECT_EQ(show_message(read_message("hex:41420000").bits, Kind::Text), "AB");
    // Bytes that would be read as something else.
    EXPECT_EQ(show_message(read_message("hex:69643a37").bits, Kind::Text), "hex:69643a37");
    EXPECT_EQ(read_message(show_message(read_message("hex:69643a37").bits, Kind::Text)).kind, Kind::Hex);
    EXPECT_EQ(show_message(read_message("hex:66696c653a37").bits, Kind::Text), "hex:66696c653a37");
}

TEST(MessageText, SaysWhatItNeeds)
{
    EXPECT_EQ(need(read_message("customer 0017")), "13 letters need 104 bits");
    EXPECT_EQ(need(read_message("x")), "1 letter needs 8 bits");
    EXPECT_EQ(need(read_message("\xC3\xAB")), "1 letter (2 bytes) needs 16 bits");
    EXPECT_EQ(need(read_message("hex:12345")), "5 hexadecimal digits need 20 bits");
    EXPECT_EQ(need(read_message("id:7")), "an id needs 32 bits");
    EXPECT_EQ(need(read_message("bits:1")), "raw bits need 1 bit");
}

TEST(MessageText, ListsOfCandidates)
{
    const std::vector<Message> list = read_candidates("\xEF\xBB\xBF"
                                                      "first\r\n\n\r\nid:2\nlast one");
    ASSERT_EQ(list.size(), 3u);
    EXPECT_EQ(list[0].text, "first");
    EXPECT_EQ(list[1].kind, Kind::Id);
    EXPECT_EQ(list[2].text, "last one");
    EXPECT_EQ(read_candidates("a\nb\n").size(), 2u);
    EXPECT_THROW((void)read_candidates(""), Error);
    EXPECT_THROW((void)read_candidates("\r\n\n"), Error);
    try {
        (void)read_candidates("good\n\nid:bad\n");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).rfind("Line 3 ", 0), 0u) << error.what();
    }
}

TEST(MessageText, AMillionCandidatesAndNoMore)
{
    std::string contents;
    for (int i = 0; i < 1'000'000; ++i)
        contents += "x\n";
    EXPECT_EQ(read_candidates(contents).size(), 1'000'000u);
    EXPECT_THROW((void)read_candidates(contents + "x"), Error);
}

} // namespace
