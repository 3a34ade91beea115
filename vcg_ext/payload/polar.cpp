// SPDX-License-Identifier: GPL-3.0-or-later
#include "polar.h"

#include "../base/error.h"
#include "soft.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <utility>

namespace vcg_ext {

namespace {

/// Which of the last 64 bits of v = (message bits, 0 elsewhere) are summed into a bit of u; the lowest is v's own.
constexpr std::uint64_t checks = 0xb5ad4eceda1ce2a9u;

using History = std::uint64_t; ///< the last 64 bits of v, the newest lowest

History extended(History history, unsigned bit)
{
    return history << 1 | bit;
}

unsigned parity(History history)
{
    return std::bitset<64>(history & checks).count() & 1;
}

int reversed(int index, int levels)
{
    int result = 0;
    for (int level = 0; level < levels; ++level)
        result |= (index >> level & 1) << (levels - 1 - level);
    return result;
}

constexpr int longest_by_weight = 7; ///< levels up to which rows are ranked by their weight alone

/// How well an index of u keeps a bit: up to 2^7 by the weight of its row (Reed-Muller), which a list of 32 can still
/// follow; above by the beta expansion (He et al. 2017), with a beta between that and the 1.19 of plain polar codes.
std::int64_t rank(int index, int levels)
{
    const std::int64_t hundredths = levels == 8 ? 110 : levels == 9 ? 113 : 116;
    std::int64_t sum = 0;
    std::int64_t power = 1'000'000'000'000;
    for (int level = 0; level < levels; ++level, power = power / 100 * hundredths)
        if (index >> level & 1)
            sum += levels <= longest_by_weight ? 1 : power;
    return sum;
}

/// Between which places of the order the choice is open: the last that would hold a bit and the next like them. Of
/// these, every so many-th in the order of u is taken. Taking the best ones instead gives many words of least weight.
std::pair<int, int> doubtful(const std::vector<int>& order, int bits, int levels)
{
    if (levels > longest_by_weight) {
        const int some = bits / 12;
        return {bits - some, std::min(bits + some, static_cast<int>(order.size()))};
    }
    const std::int64_t least = rank(order[bits - 1], levels);
    const auto below = [&](int index) { return rank(index, levels) < least; };
    const auto at_most = [&](int index) { return rank(index, levels) <= least; };
    return {static_cast<int>(std::find_if(order.begin(), order.end(), at_most) - order.begin()),
            static_cast<int>(std::find_if(order.begin(), order.end(), below) - order.begin())};
}

/// x = u F^m in place; its own inverse.
void transform(std::vector<std::uint8_t>& word)
{
    for (std::size_t half = 1; half < word.size(); half *= 2)
        for (std::size_t start = 0; start < word.size(); start += 2 * half)
            for (std::size_t i = start; i < start + half; ++i)
                word[i] ^= word[i + half];
}

/// The paths through a code, all at the same bit of u. A node of the code's tree, whose leaves are the bits of u, gets
/// the soft values of its part of every path and gives back the part's bits.
class ListDecoder {
public:
    ListDecoder(const PolarCode& code, int list) : code_(code), list_(list), cost_(1, 0.0), history_(1, 0)
    {
        for (int level = 0; level <= code.levels; ++level) {
            const std::size_t size = static_cast<std::size_t>(list) << level;
            nodes_.push_back({std::vector<double>(size), std::vector<std::uint8_t>(size),
                              std::vector<std::uint8_t>(size), std::vector<int>(list), std::vector<int>(list)});
        }
        first_ = static_cast<int>(std::find(code.holds.begin(), code.holds.end(), 1) - code.holds.begin());
    }

    /// u's word of the least cost. \param soft per index of x, positive for 0
    std::vector<std::uint8_t> best(const std::vector<double>& soft)
    {
        std::copy(soft.begin(), soft.end(), nodes_.back().soft.begin());
        decode(code_.levels, 0);
        const auto path = std::min_element(cost_.begin(), cost_.end()) - cost_.begin();
        const auto begin = nodes_.back().bits.begin() + path * static_cast<std::ptrdiff_t>(soft.size());
        return {begin, begin + static_cast<std::ptrdiff_t>(soft.size())};
    }

private:
    struct Node {
        std::vector<double> soft;       ///< paths x 2^level
        std::vector<std::uint8_t> bits; ///< paths x 2^level
        std::vector<std::uint8_t> left; ///< the bits of the left child one level up, kept while the right one is read
        std::vector<int> parent;        ///< per path: which it was when the node began
        std::vector<int> left_parent;
    };

    void decode(int level, int at)
    {
        if (level == 0)
            return code_.holds[at] ? fork() : check(at);
        const std::size_t size = std::size_t{1} << level;
        if (at + static_cast<int>(size) <= first_)
            return skip(level);
        const std::size_t half = size / 2;
        Node& node = nodes_[level];
        Node& child = nodes_[level - 1];

        for (std::size_t path = 0; path < cost_.size(); ++path) {
            const double* const a = &node.soft[path * size];
            double* const out = &child.soft[path * half];
            for (std::size_t i = 0; i < half; ++i) {
                const double least = std::min(std::abs(a[i]), std::abs(a[i + half]));
                out[i] = (a[i] < 0) != (a[i + half] < 0) ? -least : least;
            }
        }
        decode(level - 1, at);
        std::swap(child.bits, child.left);
        std::swap(child.parent, child.left_parent);

        for (std::size_t path = 0; path < cost_.size(); ++path) {
            const double* const a = &node.soft[child.left_parent[path] * size];
            const std::uint8_t* const left = &child.left[path * half];
            double* const out = &child.soft[path * half];
            for (std::size_t i = 0; i < half; ++i)
                out[i] = left[i] ? a[i + half] - a[i] : a[i + half] + a[i];
        }
        decode(level - 1, at + static_cast<int>(half));

        for (std::size_t path = 0; path < cost_.size(); ++path) {
            const int before = child.parent[path];
            const std::uint8_t* const left = &child.left[before * half];
            const std::uint8_t* const right = &child.bits[path * half];
            std::uint8_t* const out = &node.bits[path * size];
            for (std::size_t i = 0; i < half; ++i)
                out[i] = left[i] ^ right[i];
            std::copy(right, right + half, out + half);
            node.parent[path] = child.left_parent[before];
        }
    }

    /// All bits before the first one of the message are zero, on the only path there is yet.
    void skip(int level)
    {
        Node& node = nodes_[level];
        const std::size_t size = std::size_t{1} << level;
        for (std::size_t i = 0; i < size; ++i)
            cost_[0] += std::max(0.0, -node.soft[i]);
        std::fill_n(node.bits.begin(), size, 0);
        node.parent[0] = 0;
    }

    /// What it adds to the cost to say `bit` where the soft value is `soft`.
    static double penalty(double soft, unsigned bit) { return (soft < 0) != (bit == 1) ? std::abs(soft) : 0; }

    void check(int at)
    {
        Node& leaf = nodes_[0];
        for (std::size_t path = 0; path < cost_.size(); ++path) {
            history_[path] = extended(history_[path], 0);
            leaf.bits[path] = code_.zero[at] ? 0 : static_cast<std::uint8_t>(parity(history_[path]));
            cost_[path] += penalty(leaf.soft[path], leaf.bits[path]);
            leaf.parent[path] = static_cast<int>(path);
        }
    }

    /// Every path goes on with both bits; the best of them stay.
    void fork()
    {
        Node& leaf = nodes_[0];
        choices_.clear();
        for (std::size_t path = 0; path < cost_.size(); ++path)
            for (const unsigned bit : {0u, 1u})
                choices_.emplace_back(cost_[path] + penalty(leaf.soft[path], parity(extended(history_[path], bit))),
                                      static_cast<int>(2 * path + bit));
        if (choices_.size() > static_cast<std::size_t>(list_)) {
            std::nth_element(choices_.begin(), choices_.begin() + list_, choices_.end()); // equal costs: lower index
            choices_.resize(list_);
        }
        std::sort(choices_.begin(), choices_.end(), [](auto& a, auto& b) { return a.second < b.second; });

        const std::vector<History> before = history_;
        cost_.resize(choices_.size());
        history_.resize(choices_.size());
        for (std::size_t path = 0; path < choices_.size(); ++path) {
            const auto [cost, choice] = choices_[path];
            cost_[path] = cost;
            history_[path] = extended(before[choice / 2], choice & 1);
            leaf.bits[path] = static_cast<std::uint8_t>(parity(history_[path]));
            leaf.parent[path] = choice / 2;
        }
    }

    const PolarCode& code_;
    int list_;
    int first_ = 0;            ///< the first bit of u that holds one of the message
    std::vector<double> cost_; ///< per path: weight of the carriers it contradicts
    std::vector<History> history_;
    std::vector<Node> nodes_; ///< by level: at any time one node of each is open
    std::vector<std::pair<double, int>> choices_;
};

} // namespace

PolarCode polar_code(int bits, int carriers)
{
    if (carriers < 1 || carriers > 1024 || bits < 1 || bits > carriers)
        throw Error("A code has 1 to 1024 carriers and at least one bit, at most as many as carriers.");
    PolarCode code;
    code.bits = bits;
    while (1 << code.levels < carriers)
        ++code.levels;
    const int size = 1 << code.levels;

    // What has no carrier are the first or the last indices in bit-reversed order: punctured at low rates, so erased
    // and the same indices of u hold nothing, and else shortened, so zero with the same indices of u.
    const bool shortened = 5 * bits > carriers;
    std::vector<int> order;
    for (int index = 0; index < size; ++index) {
        const int turned = reversed(index, code.levels);
        const bool carried = shortened ? turned < carriers : turned >= size - carriers;
        code.zero.push_back(shortened && !carried);
        if (carried) {
            code.place.push_back(index);
            order.push_back(index);
        }
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return rank(a, code.levels) > rank(b, code.levels); });

    const auto [first, last] = doubtful(order, bits, code.levels);
    std::sort(order.begin() + first, order.begin() + last);
    code.holds.assign(size, 0);
    for (int i = 0; i < first; ++i)
        code.holds[order[i]] = 1;
    for (int i = first; i < bits; ++i)
        code.holds[order[first + (i - first) * (last - first) / (bits - first)]] = 1;
    return code;
}

Bits polar_encode(const PolarCode& code, const Bits& message)
{
    std::vector<std::uint8_t> word(code.holds.size());
    History history = 0;
    std::size_t next = 0;
    for (std::size_t i = 0; i < word.size(); ++i) {
        history = extended(history, code.holds[i] ? message[next++] & 1u : 0u);
        word[i] = code.zero[i] ? 0 : static_cast<std::uint8_t>(parity(history));
    }
    transform(word);
    Bits coded;
    for (const int place : code.place)
        coded.push_back(word[place]);
    return coded;
}

Bits polar_decode(const PolarCode& code, const std::vector<double>& soft, int list)
{
    if (soft.size() != code.place.size() || list < 1 || list > 1024)
        throw Error("Decoding needs one soft value a carrier and a list of 1 to 1024.");
    double largest = 0;
    for (const double l : soft)
        largest = std::max(largest, std::abs(usable(l)));
    // What is punctured is an erasure; what is shortened is 0, surer than all others together.
    std::vector<double> values;
    for (const std::uint8_t zero : code.zero)
        values.push_back(zero ? 4.0 * static_cast<double>(soft.size()) : 0);
    for (std::size_t k = 0; k < soft.size(); ++k)
        if (largest > 0)
            values[code.place[k]] = -usable(soft[k]) / largest;
    std::vector<std::uint8_t> word = ListDecoder(code, list).best(values);
    transform(word);

    // v from u: each bit is u's less the checks of the bits before it.
    Bits message;
    History history = 0;
    for (std::size_t i = 0; i < word.size(); ++i) {
        const unsigned bit = code.holds[i] ? word[i] ^ parity(extended(history, 0)) : 0u;
        history = extended(history, bit);
        if (code.holds[i])
            message.push_back(static_cast<std::uint8_t>(bit));
    }
    return message;
}

} // namespace vcg_ext
