// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../payload/message.h"
#include "wave_reading.h"

#include <vector>

namespace vcg_ext {

/// What the key alone says: whether phases gather at bits, whichever these are.
struct WavePresence {
    /// A way with the natural logarithm of weight / tail.
    struct Found {
        double share = 0;
        WaveWay way;
    };

    static constexpr std::size_t most_kept = 10;

    double log_p = 0;        ///< natural logarithm of a true bound of the probability without this mark
    double log_evidence = 0; ///< of the sum over ways of weight / tail
    std::vector<Found> best; ///< at least one, and most_kept at most, the best first; chosen without a look at any bit
};

/// min over ways of tail(S) / weight, S = sum of cos 4 pi y_k: the dithers are secret, so without this mark y is
/// uniform in each way.
[[nodiscard]] WavePresence wave_presence(const WaveReading& reading);

/// How well the phases match bits that are expected.
struct WaveMatch {
    double log_p = 0; ///< natural logarithm of a true bound
    WaveWay way;
    double sum = 0; ///< sum of cos 2 pi (y_k - b_k / 2) there
};

/// min over ways of P(sum of +-l_k >= sum of l_k (-1)^b_k) / w, l_k = cos 2 pi y_k, w a weight of the way.
///
/// Given all y, the signs of l_k against the bits are fair coins, because the mask is secret. So this holds for any
/// mesh without a mark of this key (of one with another message they are where the two differ); and weights may look at
/// y: half of them is as before looking, half goes by weight / tail of wave_presence(), which is next to all for the way
/// where phases gather. Not below 2^-K: what the phases' gathering itself is worth, wave_presence() says.
///
/// \pre the mask that `coded` was XOR-ed with is uniform and independent of the plan
[[nodiscard]] WaveMatch wave_match(const WaveReading& reading, const WavePresence& presence, const Bits& coded);

/// A way of reading as a decoder takes it.
struct WaveSoft {
    double weight = 0;        ///< posterior; never looks at bits
    std::vector<double> soft; ///< log-likelihood ratio of coded bit 1 against 0, by wave
};

/// The `most` best ways, by weight / tail, the best first; at most what wave_presence() kept.
[[nodiscard]] std::vector<WaveSoft> wave_ways(const WaveReading& reading, const WavePresence& presence, int most);

/// Log-likelihood ratios of coded bit 1 against 0: -2 k cos 2 pi y_k, with the concentration k at which cos 4 pi y_k
/// has the mean that it has.
[[nodiscard]] std::vector<double> wave_soft(const std::vector<double>& phases);

} // namespace vcg_ext
