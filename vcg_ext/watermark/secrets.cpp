// SPDX-License-Identifier: GPL-3.0-or-later
#include "secrets.h"

namespace vcg_ext {

Bits bit_mask(const Key& key, const std::string& secret, int count)
{
    Stream draws = key.stream("bit-mask " + secret);
    Bits mask(count);
    for (std::uint8_t& bit : mask)
        bit = static_cast<std::uint8_t>(draws.below(2));
    return mask;
}

Bits masked(Bits bits, const Bits& mask)
{
    for (std::size_t i = 0; i < bits.size(); ++i)
        bits[i] ^= mask[i];
    return bits;
}

std::vector<double> unmasked(std::vector<double> soft, const Bits& mask)
{
    for (std::size_t i = 0; i < soft.size(); ++i)
        if (mask[i])
            soft[i] = -soft[i];
    return soft;
}

Bits hard_bits(const std::vector<double>& soft)
{
    Bits bits(soft.size());
    for (std::size_t i = 0; i < bits.size(); ++i)
        bits[i] = soft[i] > 0;
    return bits;
}

} // namespace vcg_ext
