// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../method/marking.h"
#include "../payload/message_text.h"

#include <vector>

namespace vcg_ext {

struct EmbedOptions {
    CarrierOptions carriers; ///< `bits` 0: as many as are recommended for the message
    Message message;
    PlacementOptions placement;
    /// Per vertex whether it must not slide along the surface, as on the seams of a texture; empty: none. Waves, which
    /// moves all of the surface, and hardly at all along itself, asks nothing of it.
    std::vector<char> held;
};

struct DetectOptions {
    CarrierOptions carriers; ///< `bits` 0: the number is found
    /// The message that should be there, or a list of which one may be; empty to read with the key alone.
    std::vector<Message> expected;
};

} // namespace vcg_ext
