// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

#include <cstdint>

namespace vcg_ext {

/// Additive noise (3.24): every vertex of a face moves by `amplitude` times the largest norm, each in its own uniformly
/// random direction. Norms are distances from the area-weighted centre (5.1). Gives the new positions.
[[nodiscard]] Points noise(const Surface& surface, double amplitude, std::uint64_t seed);

} // namespace vcg_ext
