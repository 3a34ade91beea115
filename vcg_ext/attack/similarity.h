// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

#include <cstdint>

namespace vcg_ext {

/// A uniformly random rotation and a scale uniform in [0.5, 2] about the centre of the bounding box, then a shift of at
/// most one diagonal per axis. Gives the new positions.
[[nodiscard]] Points similarity(const Points& points, std::uint64_t seed);

} // namespace vcg_ext
