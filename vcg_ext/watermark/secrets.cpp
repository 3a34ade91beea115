// SPDX-License-Identifier: GPL-3.0-or-later
#include "secrets.h"

namespace vcg_ext {

Bits bit_mask(const Key& key, int count)
{
    Stream draws = key.stream("bit-mask");
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

std::vector<double> unmasked(const Reading& reading, const Bits& mask)
{
    std::vector<double> soft = reading.soft;
    for (std::size_t i = 0; i < soft.size(); ++i)
        if (mask[i])
            soft[i] = -soft[i];
    return soft;
}

Bits hard_bits(const Reading& reading, const Bits& mask)
{
    Bits bits(mask.size());
    for (std::size_t i = 0; i < bits.size(); ++i)
        bits[i] = reading.soft[i] > 0;
    return masked(std::move(bits), mask);
}

} // namespace vcg_ext
