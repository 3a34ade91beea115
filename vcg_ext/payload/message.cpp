// SPDX-License-Identifier: GPL-3.0-or-later
#include "message.h"

#include "../base/error.h"
#include "../base/text.h"

#include <algorithm>

namespace vcg_ext {

namespace {

void append(Bits& bits, unsigned value, int count)
{
    for (int bit = count - 1; bit >= 0; --bit)
        bits.push_back(value >> bit & 1);
}

Bits parse_digits(std::string_view digits, int bits_a_digit, const char* what)
{
    Bits bits;
    for (const char c : digits) {
        const int value = c >= '0' && c <= '9'   ? c - '0'
                          : c >= 'a' && c <= 'f' ? c - 'a' + 10
                          : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                                 : 16;
        if (value >= 1 << bits_a_digit)
            throw Error("The message has '" + std::string(1, c) + "' where only " + what +
                        " may stand. Correct it, or give the message as plain text.");
        append(bits, value, bits_a_digit);
    }
    return bits;
}

/// The bits in groups of `width`, from the highest; the last group is filled up with zeros.
std::vector<unsigned> group(const Bits& bits, std::size_t width)
{
    std::vector<unsigned> groups((bits.size() + width - 1) / width, 0);
    for (std::size_t i = 0; i < bits.size(); ++i)
        groups[i / width] |= bits[i] << (width - 1 - i % width);
    return groups;
}

/// Length of the UTF-8 character of code point >= U+00A0 at `at`, or 0 where there is none.
std::size_t multibyte_length(const std::string& text, std::size_t at)
{
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    const unsigned lead = byte(at);
    const std::size_t length = lead >= 0xF0 && lead <= 0xF4  ? 4
                               : lead >= 0xE0 && lead < 0xF0 ? 3
                               : lead >= 0xC2 && lead < 0xE0 ? 2
                                                             : 0;
    if (length == 0)
        return 0;
    unsigned code = lead & (0xFFu >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(at + i) & 0xC0u) != 0x80u)
            return 0;
        code = code << 6 | (byte(at + i) & 0x3Fu);
    }
    constexpr unsigned smallest[] = {0, 0, 0xA0, 0x800, 0x10000};
    const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
    return code >= smallest[length] && code <= 0x10FFFF && !surrogate ? length : 0;
}

bool printable(const std::string& text)
{
    for (std::size_t at = 0; at < text.size();) {
        const bool ascii = text[at] >= 0x20 && text[at] < 0x7F;
        const std::size_t length = ascii ? 1 : multibyte_length(text, at);
        if (length == 0)
            return false;
        at += length;
    }
    return true;
}

} // namespace

Bits parse_message(std::string_view text)
{
    Bits bits;
    if (starts_with(text, "bits:"))
        bits = parse_digits(text.substr(5), 1, "0 and 1");
    else if (starts_with(text, "hex:"))
        bits = parse_digits(text.substr(4), 4, "hexadecimal digits");
    else
        for (const char c : text)
            append(bits, static_cast<unsigned char>(c), 8);
    if (bits.empty())
        throw Error("The message is empty. Give a text, hex:C0FFEE or bits:0110.");
    return bits;
}

Bits pad_message(Bits message, int count)
{
    const auto is_set = [](std::uint8_t bit) { return bit != 0; };
    const std::size_t wanted = count;
    if (message.size() > wanted &&
        (message.size() - wanted >= 4 || std::any_of(message.begin() + count, message.end(), is_set)))
        throw Error("The message has " + std::to_string(message.size()) + " bits, but only " + std::to_string(count) +
                    " are there to carry it. Shorten it, or set Bits to " + std::to_string(message.size()) +
                    " or more.");
    message.resize(wanted, 0);
    return message;
}

std::string format_message(const Bits& bits)
{
    std::string text;
    for (const unsigned byte : group(bits, 8))
        text.push_back(static_cast<char>(byte));
    text.erase(text.find_last_not_of('\0') + 1);
    const bool whole_bytes = 8 * text.size() <= bits.size();
    if (!text.empty() && whole_bytes && printable(text) && !starts_with(text, "hex:") && !starts_with(text, "bits:"))
        return text;

    std::string hex = "hex:";
    for (const unsigned digit : group(bits, 4))
        hex.push_back("0123456789abcdef"[digit]);
    return hex;
}

std::string bit_string(const Bits& bits)
{
    std::string text;
    for (const std::uint8_t bit : bits)
        text.push_back(bit ? '1' : '0');
    return text;
}

} // namespace vcg_ext
