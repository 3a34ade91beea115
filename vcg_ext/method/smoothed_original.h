// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../carrier/wave_body.h"
#include "../geometry/edge_graph.h"
#include "copy.h"

#include <memory>

namespace vcg_ext {

/// The original after as many rounds of smoothing, with uniform weights and by a half, as bring it nearest to a copy.
struct SmoothedOriginal {
    int rounds = 0;                         ///< 0: none is seen, and all else is empty
    Registration registration;              ///< of the copy on it
    std::unique_ptr<const FootSearch> feet; ///< on it
};

/// Never looks at waves. \param body, graph of the original
[[nodiscard]] SmoothedOriginal smoothed_original(const Copy& copy, const WaveBody& body, const EdgeGraph& graph);

} // namespace vcg_ext
