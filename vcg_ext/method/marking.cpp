// SPDX-License-Identifier: GPL-3.0-or-later
#include "marking.h"

#include "../base/text.h"

#include <algorithm>

namespace vcg_ext {

namespace {
constexpr double most_trim = 0.45;
}

void CarrierOptions::check() const
{
    if (bits < 0 || bits > most_carriers)
        throw Error("Bits is " + std::to_string(bits) + ", but must lie between 1 and " +
                    std::to_string(most_carriers) + ", or be 0 to be found.");
    if (!(trim == -1 || (trim >= 0 && trim <= most_trim)))
        throw Error("Trim is " + text(trim) + ", but must lie between 0 and " + text(most_trim) +
                    ", or be -1 to be drawn from the key.");
}

void PlacementOptions::check() const
{
    if (max_rounds < 1)
        throw Error("Embedding needs at least one round.");
    if (sphere.sweeps < 1)
        throw Error("The sphere placement needs at least one sweep.");
    const auto [least, most] = std::minmax_element(sphere.weights.begin(), sphere.weights.end());
    if (!(*least >= 0 && *most > 0 && *most < 1e9))
        throw Error("The sphere placement's weights must not be negative, and not all zero.");
}

} // namespace vcg_ext
