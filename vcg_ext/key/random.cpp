// SPDX-License-Identifier: GPL-3.0-or-later
#include "random.h"

namespace vcg_ext {

Stream seeded_stream(std::uint64_t seed, std::string_view purpose, std::uint64_t part)
{
    std::array<unsigned char, 32> subkey{};
    for (int i = 0; i < 8; ++i) {
        subkey[i] = static_cast<unsigned char>(seed >> 8 * i);
        subkey[8 + i] = static_cast<unsigned char>(part >> 8 * i);
    }
    purpose.copy(reinterpret_cast<char*>(subkey.data()) + 16, 16);
    return Stream(subkey);
}

double uniform(Stream& stream)
{
    return static_cast<double>(stream.next() >> 11) * 0x1p-53;
}

Point integer_direction(Stream& stream)
{
    constexpr std::int64_t radius = 1 << 20;
    while (true) {
        std::int64_t p[3];
        std::int64_t square = 0;
        for (std::int64_t& x : p) {
            x = static_cast<std::int64_t>(stream.below(2 * radius + 1)) - radius;
            square += x * x;
        }
        if (square > 0 && square <= radius * radius)
            return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
    }
}

} // namespace vcg_ext
