// SPDX-License-Identifier: GPL-3.0-or-later
#include "find.h"

#include "code.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>

namespace vcg_ext {

namespace {

constexpr double enough = -6; // log10 of the p-value at which a find is a find

using Words = std::vector<std::uint64_t>;

/// Sum of c_k l_k by bytes of a packed word: per byte and its value the sum over its eight carriers.
class Correlator {
public:
    explicit Correlator(const std::vector<double>& soft) : sums_((soft.size() + 7) / 8)
    {
        for (std::size_t byte = 0; byte < sums_.size(); ++byte)
            for (unsigned value = 0; value < 256; ++value) {
                std::vector<double> part(soft.begin() + 8 * byte, soft.begin() + std::min(8 * byte + 8, soft.size()));
                Bits bits;
                for (std::size_t i = 0; i < part.size(); ++i)
                    bits.push_back(value >> i & 1);
                sums_[byte][value] = agreement(bits, part);
            }
    }

    [[nodiscard]] double total(const Words& word) const
    {
        double sum = 0;
        for (std::size_t byte = 0; byte < sums_.size(); ++byte)
            sum += sums_[byte][word[byte / 8] >> 8 * (byte % 8) & 255];
        return sum;
    }

private:
    std::vector<std::array<double, 256>> sums_;
};

/// The codes of a list of messages, each made once.
class Codes {
public:
    explicit Codes(int carriers) : carriers_(carriers) {}

    Words word(const Message& message)
    {
        if (message.kind == Kind::Bits)
            return packed_bits(encode(message, carriers_));
        const int bits = coded_length(static_cast<int>(message.bits.size()), carriers_);
        const std::pair<int, bool> name(bits, message.kind == Kind::Id);
        auto found = codes_.find(name);
        if (found == codes_.end())
            found = codes_.emplace(name, Code(bits, carriers_, message.kind)).first;
        return found->second.packed(message.bits);
    }

private:
    int carriers_;
    std::map<std::pair<int, bool>, Code> codes_;
};

} // namespace

double expected_log_p(const Message& expected, const std::vector<double>& soft)
{
    return log_tail(soft, agreement(encode(expected, static_cast<int>(soft.size())), soft));
}

std::optional<Found> find_message(const std::vector<double>& soft, int list)
{
    const int carriers = static_cast<int>(soft.size());
    const SignTail tail(soft);
    std::optional<Found> best;
    for (const Hypothesis& way : hypotheses(carriers)) {
        const Code code(way.bits, carriers, way.kind);
        Found found{code.decode(soft, list), way.kind};
        found.total = agreement(code.encode(found.bits), soft);
        found.log10_p = tail.log10_p(found.total);
        found.log10_any = log_best_of({{log_any_message(found.log10_p, way.bits), way.weight}});
        if (!best || found.log10_any < best->log10_any)
            best = found;
        if (best->log10_any < enough)
            break;
    }
    return best;
}

bool says(const Found& found, const Message& message, int carriers)
{
    const int bits = static_cast<int>(message.bits.size());
    return message.kind != Kind::Bits && bits <= carriers && (found.kind == Kind::Id) == (message.kind == Kind::Id) &&
           found.bits == pad_message(message.bits, coded_length(bits, carriers));
}

Ranking rank_candidates(const std::vector<Message>& list, const std::vector<double>& soft)
{
    Ranking ranking;
    const Correlator correlator(soft);
    Codes codes(static_cast<int>(soft.size()));
    Words best_word;
    double best = 0;
    double second = 0;
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (list[i].bits.size() > soft.size())
            continue;
        const Words word = codes.word(list[i]);
        const double total = correlator.total(word);
        if (ranking.best < 0 || total > best) {
            if (word == best_word)
                continue;
            ranking.runner_up = ranking.best;
            second = best;
            ranking.best = static_cast<int>(i);
            best = total;
            best_word = word;
        } else if ((ranking.runner_up < 0 || total > second) && word != best_word) {
            ranking.runner_up = static_cast<int>(i);
            second = total;
        }
    }
    const SignTail tail(soft);
    const double count = static_cast<double>(list.size());
    if (ranking.best >= 0)
        ranking.log10_p = log_any_of(tail.log10_p(best), count);
    if (ranking.runner_up >= 0)
        ranking.runner_up_log10_p = log_any_of(tail.log10_p(second), count);
    return ranking;
}

} // namespace vcg_ext
