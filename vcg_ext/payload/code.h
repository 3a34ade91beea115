// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "message_text.h"
#include "polar.h"

#include <cstdint>
#include <string>
#include <vector>

namespace vcg_ext {

/// The step from a message to coded bits, one a carrier, and back.
///
/// **Lengths.** A detector with the key alone does not know how long the message is. Signalling the length costs bits
/// that must survive; padding every message to half of the carriers costs 2^padding in the p-value of what was read. So
/// messages are padded with zeros to a few lengths only (coded_length(): steps of 6 to 12 %), every length has a code
/// of its own, and the detector tries them: each with a weight, fixed before looking, that divides its p. That costs 1
/// bit at the length that the number of carriers was recommended for, and 3 to 8 elsewhere.
///
/// **Kinds.** An id's words are xored with another pattern than those of a text of 32 bits: a way of reading more, in
/// place of a bit in the message. Text and hex are the same bits.
///
/// **Differences.** The code is linear, so messages that differ in one bit differ in one fixed word of it. Messages
/// pass through an invertible matrix over GF(2) first, drawn once for all (no secret: the key's mask is one) with words
/// of 45 to 55 % ones in its rows where there are enough such words: one bit always changes about half of the carriers.
class Code {
public:
    /// \param bits message bits, 1 to `carriers`; a message is filled up to them with zeros
    /// \param carriers 1 to 1024  \param kind Id or another: not of raw bits
    Code(int bits, int carriers, Kind kind);

    /// \throw Error where the message is longer than the code's
    [[nodiscard]] Bits encode(const Bits& message) const;

    /// The message that agrees best. \param soft one a carrier, positive for 1, 0 for an erasure; \param list paths
    [[nodiscard]] Bits decode(const std::vector<double>& soft, int list = 32) const;

private:
    using Words = std::vector<std::uint64_t>; ///< bits in words of 64, from the lowest

    [[nodiscard]] Words packed(const Bits& message) const;

    PolarCode code_;
    Words offset_;           ///< of all words of this length and kind
    std::vector<Words> row_; ///< per message bit: the word that it adds
    /// The inverse matrix, by elimination: where the polar code's message has bit `pivot`, `row` is taken off it and
    /// `message` is added to ours.
    struct Step {
        int pivot = 0;
        Words row, message;
    };
    std::vector<Step> inverse_;
};

/// One way to read so many carriers.
struct Hypothesis {
    int bits = 0;           ///< message bits, with the padding
    Kind kind = Kind::Text; ///< Text or Id
    double weight = 0;      ///< above 0; all of them sum to 1
};

/// What the detector tries where it knows the key and the number of carriers only: lengths of coded_length() that leave
/// 20 carriers or more over, as fewer could never prove anything, the next to half of the carriers first. The i-th from
/// 1 weighs 1 / (i (i + 1)); text and id share 32 bits equally. Empty below 28 carriers.
[[nodiscard]] std::vector<Hypothesis> hypotheses(int carriers);

/// The length that a message of `bits` is padded to: the next multiple of 8 up to 128, 16 up to 256, 32 up to 512, 64
/// above; but `carriers` where that is less.
[[nodiscard]] int coded_length(int bits, int carriers);

/// 64, 96, 128, 192, 256, 384, 512, 768, 1024: the numbers of carriers that recommended_carriers() chooses from.
[[nodiscard]] std::vector<int> recommended_numbers();

/// The least of recommended_numbers() that is at least twice the message's bits (raw bits: that is at least their
/// number). \throw Error where there is none: says what the message needs
[[nodiscard]] int recommended_carriers(const Message& message);

/// log10 of the best that a reader with the key alone can ever get for a message of this length: all signs right.
/// 1e-6 is out of reach where it is above -6.
[[nodiscard]] double clean_log_p(const Message& message, int carriers);

/// The message's coded bits; raw bits as they are, filled up with zeros.
/// \throw Error where there are more bits than carriers: "13 letters need 104 bits"
[[nodiscard]] Bits encode(const Message& message, int carriers);

/// The message of a known length and kind, padded as coded_length() says; raw bits are the signs.
[[nodiscard]] Bits decode(const std::vector<double>& soft, int bits, Kind kind = Kind::Text);

} // namespace vcg_ext
