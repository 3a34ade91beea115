// SPDX-License-Identifier: GPL-3.0-or-later
#include "code.h"

#include "../base/error.h"
#include "../key/random.h"
#include "soft.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <cstdlib>

namespace vcg_ext {

namespace {

constexpr std::array<int, 9> ladder = {64, 96, 128, 192, 256, 384, 512, 768, 1024};
constexpr int carriers_over = 20; // 2^-20 is just below 1e-6

using Words = std::vector<std::uint64_t>;

Bits unpacked(const Words& words, int count)
{
    Bits bits;
    for (int i = 0; i < count; ++i)
        bits.push_back(words[i / 64] >> i % 64 & 1);
    return bits;
}

void add(Words& to, const Words& words)
{
    for (std::size_t i = 0; i < words.size(); ++i)
        to[i] ^= words[i];
}

int ones(const Words& words)
{
    std::size_t count = 0;
    for (const std::uint64_t word : words)
        count += std::bitset<64>(word).count();
    return static_cast<int>(count);
}

bool has(const Words& words, int bit)
{
    return words[bit / 64] >> bit % 64 & 1;
}

Words drawn(Stream& stream, int bits)
{
    Words words((bits + 63) / 64);
    for (std::uint64_t& word : words)
        word = stream.next();
    if (bits % 64 != 0)
        words.back() &= (std::uint64_t{1} << bits % 64) - 1;
    return words;
}

/// The lowest bit that is set, or -1.
int lowest(const Words& words)
{
    for (std::size_t i = 0; i < words.size(); ++i)
        for (int bit = 0; words[i] != 0 && bit < 64; ++bit)
            if (words[i] >> bit & 1)
                return static_cast<int>(64 * i) + bit;
    return -1;
}

/// The weight of the i-th from 0 of so many things to try, the likeliest first; the last takes what is left of 1.
double weight_of(std::size_t i, std::size_t count)
{
    const double rank = static_cast<double>(i + 1);
    return 1 / (i + 1 < count ? rank * (rank + 1) : rank);
}

/// The step between padded lengths at a length.
int step(int bits)
{
    return bits <= 128 ? 8 : bits <= 256 ? 16 : bits <= 512 ? 32 : 64;
}

Words packed_bits(const Bits& bits)
{
    Words words((bits.size() + 63) / 64, 0);
    for (std::size_t i = 0; i < bits.size(); ++i)
        words[i / 64] |= std::uint64_t{bits[i] != 0} << i % 64;
    return words;
}

} // namespace

Code::Code(int bits, int carriers, Kind kind) : code_(polar_code(bits, carriers))
{
    const std::uint64_t number = (std::uint64_t{kind == Kind::Id} << 22) + (std::uint64_t(bits) << 11) + carriers;
    Stream offset = seeded_stream(number, "payload-offset");
    offset_ = drawn(offset, carriers);

    Stream stream = seeded_stream(number, "payload-rows");
    for (int drawing = 0; static_cast<int>(row_.size()) < bits; ++drawing) {
        Step step{0, drawn(stream, bits), Words((bits + 63) / 64, 0)};
        const Words word = packed_bits(polar_encode(code_, unpacked(step.row, bits)));
        const bool about_half = std::abs(2 * ones(word) - carriers) * 10 <= carriers;
        if (!about_half && drawing < 4 * bits + 64) // short codes may not have so many
            continue;
        step.message[row_.size() / 64] |= std::uint64_t{1} << row_.size() % 64;
        for (const Step& before : inverse_)
            if (has(step.row, before.pivot)) {
                add(step.row, before.row);
                add(step.message, before.message);
            }
        step.pivot = lowest(step.row);
        if (step.pivot < 0)
            continue; // a sum of the rows before
        row_.push_back(word);
        inverse_.push_back(step);
    }
}

Words Code::packed(const Bits& message) const
{
    if (message.size() > row_.size())
        throw Error("The message has " + std::to_string(message.size()) + " bits, more than the " +
                    std::to_string(row_.size()) + " of its code.");
    Words word = offset_;
    for (std::size_t i = 0; i < message.size(); ++i)
        if (message[i])
            add(word, row_[i]);
    return word;
}

Bits Code::encode(const Bits& message) const
{
    return unpacked(packed(message), static_cast<int>(code_.place.size()));
}

Bits Code::decode(const std::vector<double>& soft, int list) const
{
    std::vector<double> values = soft;
    for (std::size_t k = 0; k < values.size() && k < code_.place.size(); ++k)
        if (has(offset_, static_cast<int>(k)))
            values[k] = -values[k];
    Words rest = packed_bits(polar_decode(code_, values, list));
    Words message(rest.size(), 0);
    for (const Step& step : inverse_)
        if (has(rest, step.pivot)) {
            add(rest, step.row);
            add(message, step.message);
        }
    return unpacked(message, code_.bits);
}

std::vector<Hypothesis> hypotheses(int carriers)
{
    std::vector<int> lengths;
    for (int bits = 8; bits + carriers_over <= carriers; bits += step(bits + 1))
        lengths.push_back(bits);
    std::stable_sort(lengths.begin(), lengths.end(),
                     [&](int a, int b) { return std::abs(2 * a - carriers) < std::abs(2 * b - carriers); });
    std::vector<Hypothesis> result;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        const double weight = weight_of(i, lengths.size());
        if (lengths[i] == 32) {
            result.push_back({32, Kind::Id, weight / 2});
            result.push_back({32, Kind::Text, weight / 2});
        } else {
            result.push_back({lengths[i], Kind::Text, weight});
        }
    }
    return result;
}

int coded_length(int bits, int carriers)
{
    const int width = step(bits);
    return std::min((bits + width - 1) / width * width, carriers);
}

std::vector<int> recommended_numbers()
{
    return {ladder.begin(), ladder.end()};
}

int recommended_carriers(const Message& message)
{
    const int bits = static_cast<int>(message.bits.size());
    const int wanted = message.kind == Kind::Bits ? bits : 2 * bits;
    for (const int carriers : ladder)
        if (carriers >= wanted)
            return carriers;
    throw Error("The message is too long: " + need(message) + ", and up to " +
                std::to_string(message.kind == Kind::Bits ? ladder.back() : ladder.back() / 2) +
                " can be hidden so that they survive. Shorten it.");
}

double clean_log_p(const Message& message, int carriers)
{
    if (message.kind == Kind::Bits)
        return 0;
    const int bits = coded_length(static_cast<int>(message.bits.size()), carriers);
    double best = 0;
    for (const Hypothesis& way : hypotheses(carriers))
        if (way.bits == bits && (way.kind == Kind::Id) == (message.kind == Kind::Id))
            best = std::min(0.0, (bits - carriers) * log10_2 - std::log10(way.weight));
    return best;
}

Bits encode(const Message& message, int carriers)
{
    const int bits = static_cast<int>(message.bits.size());
    if (bits > carriers)
        throw Error("The message does not fit: " + need(message) + ", but Bits is " + std::to_string(carriers) +
                    ". Shorten it, or set Bits to 0, which takes as many as it needs.");
    if (message.kind == Kind::Bits)
        return pad_message(message.bits, carriers);
    return Code(coded_length(bits, carriers), carriers, message.kind).encode(message.bits);
}

Bits decode(const std::vector<double>& soft, int bits, Kind kind)
{
    const int carriers = static_cast<int>(soft.size());
    if (kind == Kind::Bits) {
        Bits signs;
        for (const double l : soft)
            signs.push_back(l > 0);
        return signs;
    }
    return Code(coded_length(bits, carriers), carriers, kind).decode(soft);
}

} // namespace vcg_ext
