// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge.h"

#include "../payload/binomial.h"
#include "secrets.h"

#include <algorithm>

namespace vcg_ext {

Judgement judge(const Readings& readings, const Bits& mask, const std::optional<Bits>& expected)
{
    Judgement result;
    result.way = readings.blind;
    if (!expected) {
        result.bits = hard_bits(readings.ways[result.way], mask);
        return result;
    }
    int most = -1;
    for (std::size_t way = 0; way < readings.ways.size(); ++way) {
        Bits bits = hard_bits(readings.ways[way], mask);
        const int matches = matching_bits(*expected, bits);
        if (matches > most) {
            most = matches;
            result.way = static_cast<int>(way);
            result.bits = std::move(bits);
        }
    }
    const int bits = static_cast<int>(mask.size());
    result.detection_ratio = static_cast<double>(most) / bits;
    result.p_value = std::min(1.0, binomial_tail(bits, most) / readings.ways[result.way].weight);
    result.present = *result.p_value < 1e-6;
    return result;
}

} // namespace vcg_ext
