// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "evidence.h"
#include "message_text.h"

#include <optional>
#include <vector>

namespace vcg_ext {

/// What soft values say: one a carrier, in the order of the code, with the key's mask taken off; positive for 1, 0 for
/// an erasure, of any scale. All probabilities as in evidence.h, for this one reading: a method that reads in several
/// ways weighs them (log_best_of).

/// log10 of the probability that a mesh without this mark agrees so well with the expected message (p_value).
/// \throw Error where the message has more bits than there are carriers
[[nodiscard]] double expected_log_p(const Message& expected, const std::vector<double>& soft);

/// A message read with the key alone.
struct Found {
    Bits bits; ///< with the zeros that it was padded with
    Kind kind = Kind::Text;
    double total = 0;     ///< sum of c_k l_k over its word
    double log10_p = 0;   ///< of agreeing so well with this word, had it been named before
    double log10_any = 0; ///< of agreeing so well with any word of any of the hypotheses(): p_message
};

/// The message of the least `log10_any` of all lengths and kinds, or the first one below 1e-6, the likeliest tried
/// first; nothing below 28 carriers. `log10_any` is an upper bound however good the decoder is: it counts all 2^n words
/// of each way of reading.
[[nodiscard]] std::optional<Found> find_message(const std::vector<double>& soft, int list = 32);

/// Whether what was found in so many carriers is this message. One that is proven and another tells what the mesh
/// carries.
[[nodiscard]] bool says(const Found& found, const Message& message, int carriers);

/// The best of a list of messages.
struct Ranking {
    int best = -1;      ///< its index in the list; -1 where none fits into the carriers
    double log10_p = 0; ///< p of its word times the number of messages
    int runner_up = -1; ///< the best with another word, so that a repeated line is none; -1 where there is none
    double runner_up_log10_p = 0; ///< likewise times the number
};

/// The message of the list that agrees best. Linear in the list: messages that have more bits than there are carriers
/// are passed over, and count.
[[nodiscard]] Ranking rank_candidates(const std::vector<Message>& list, const std::vector<double>& soft);

} // namespace vcg_ext
