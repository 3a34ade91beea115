// SPDX-License-Identifier: GPL-3.0-or-later
#include "message_text.h"

#include "../base/error.h"
#include "../base/text.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace vcg_ext {

namespace {

constexpr std::size_t most_candidates = 1'000'000;
constexpr std::string_view id_prefix = "id:";
constexpr std::string_view list_prefix = "file:"; // of candidates, which the doors read

Bits read_id(std::string_view digits)
{
    std::uint32_t number = 0;
    const char* const end = digits.data() + digits.size();
    const auto [stopped, error] = std::from_chars(digits.data(), end, number);
    if (error != std::errc() || stopped != end)
        throw Error("An id is a whole number from 0 to 4294967295, such as id:17, but the message is 'id:" +
                    std::string(digits) + "'. Correct it, or give the message as plain text.");
    Bits bits;
    for (int bit = 31; bit >= 0; --bit)
        bits.push_back(number >> bit & 1);
    return bits;
}

std::string counted(std::size_t count, const std::string& thing)
{
    return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

} // namespace

Message read_message(std::string_view text)
{
    if (starts_with(text, list_prefix))
        throw Error("A message does not begin with 'file:', which names a list of messages that detection looks for. "
                    "Give the message itself.");
    if (starts_with(text, id_prefix))
        return {Kind::Id, read_id(text.substr(id_prefix.size())), std::string(text)};
    const Kind kind = starts_with(text, "hex:") ? Kind::Hex : starts_with(text, "bits:") ? Kind::Bits : Kind::Text;
    return {kind, parse_message(text), std::string(text)};
}

std::string show_message(const Bits& bits, Kind kind)
{
    if (kind == Kind::Bits)
        return "bits:" + bit_string(bits);
    if (kind == Kind::Id && bits.size() == 32) {
        std::uint32_t number = 0;
        for (const std::uint8_t bit : bits)
            number = number << 1 | bit;
        return std::string(id_prefix) + std::to_string(number);
    }
    std::string text = format_message(bits);
    if (!starts_with(text, id_prefix) && !starts_with(text, list_prefix))
        return text;
    static constexpr char digits[] = "0123456789abcdef";
    std::string hex = "hex:";
    for (const char c : text) {
        hex.push_back(digits[static_cast<unsigned char>(c) >> 4]);
        hex.push_back(digits[c & 15]);
    }
    return hex;
}

std::string need(const Message& message)
{
    const std::size_t bits = message.bits.size();
    std::string what;
    std::size_t count = 1;
    if (message.kind == Kind::Text) {
        const auto begins = [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; };
        const std::size_t bytes = message.text.size();
        count = std::count_if(message.text.begin(), message.text.end(), begins);
        what = counted(count, "letter");
        if (bytes != count)
            what += " (" + counted(bytes, "byte") + ")";
    } else if (message.kind == Kind::Hex) {
        count = bits / 4;
        what = counted(count, "hexadecimal digit");
    } else {
        what = message.kind == Kind::Id ? "an id" : "raw bits";
        count = message.kind == Kind::Id ? 1 : 2;
    }
    return what + (count == 1 ? " needs " : " need ") + counted(bits, "bit");
}

std::vector<Message> read_candidates(std::string_view contents)
{
    if (starts_with(contents, "\xEF\xBB\xBF"))
        contents.remove_prefix(3);
    std::vector<Message> messages;
    for (std::size_t line = 1; !contents.empty(); ++line) {
        const std::size_t end = std::min(contents.find('\n'), contents.size());
        std::string_view text = contents.substr(0, end);
        contents.remove_prefix(std::min(end + 1, contents.size()));
        if (!text.empty() && text.back() == '\r')
            text.remove_suffix(1);
        if (text.empty())
            continue;
        if (messages.size() == most_candidates)
            throw Error("The list of candidates has more than a million messages. Split it into several.");
        try {
            messages.push_back(read_message(text));
        } catch (const Error& error) {
            throw Error("Line " + std::to_string(line) + " of the list of candidates: " + error.what());
        }
    }
    if (messages.empty())
        throw Error("The list of candidates is empty. Write one message a line.");
    return messages;
}

} // namespace vcg_ext
