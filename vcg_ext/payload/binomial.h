// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "message.h"

namespace vcg_ext {

/// Probability that at least `k` of `n` fair coins show heads: what `k` matching bits are worth as evidence.
///
/// The message is masked with the key, so on a mesh without this mark the number of matches is Binomial(n, 1/2)
/// exactly. Relative error below 1e-12 for n up to 1024, also where the probability is tiny.
///
/// \throw Error where `n` is negative
[[nodiscard]] double binomial_tail(int n, int k);

/// How many bits are the same in both. \throw Error where the lengths differ
[[nodiscard]] int matching_bits(const Bits& expected, const Bits& found);

} // namespace vcg_ext
