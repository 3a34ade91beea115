// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../carrier/shells.h"
#include "../carrier/strips.h"
#include "../carrier/wave_spectra.h"
#include "../geometry/moments.h"
#include "../key/key.h"
#include "marking.h"

#include <memory>
#include <variant>

namespace vcg_ext {

class WaveCopy; // wave_copy.h

/// What both sides agree on before they see a mesh. The secret mask of the bits is no part of it, so nothing that reads
/// by a plan can look at it.
struct Plan {
    CarrierOptions options;
    double trim = 0; ///< as used
    std::vector<int>
        order;         ///< keyed: shell, strip or patch order[i] carries coded bit i; those after the last are spare
    Points directions; ///< keyed: where to look for the source of geodesic distances
    WavePlan waves;    ///< keyed
};

/// How a body is held, so that its carriers can be found, however many these are: by the surface itself, or by another
/// that it was registered to. Which kind, the method says.
using MarkFrame =
    std::variant<ShellFrame, StripFrames, Frame, std::shared_ptr<WaveSpectra>, std::shared_ptr<const WaveCopy>>;

} // namespace vcg_ext
