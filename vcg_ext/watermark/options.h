// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../method/marking.h"
#include "../payload/message.h"

#include <optional>

namespace vcg_ext {

struct EmbedOptions {
    CarrierOptions carriers; ///< `bits` 0 takes the message's length
    Bits message;            ///< at most as long as there are carriers; what is left is zero
    PlacementOptions placement;
};

struct DetectOptions {
    CarrierOptions carriers;
    std::optional<Bits> expected; ///< the message to compare with, padded with zeros
};

} // namespace vcg_ext
