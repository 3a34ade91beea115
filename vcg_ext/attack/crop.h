// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

#include <cstdint>

namespace vcg_ext {

/// Cuts the part `amount` of the faces off by a plane with a uniformly random normal: those whose centres lie farthest
/// along it. Whole faces go, and the vertices that no face needs any more; the others keep their order.
/// \pre 0 <= amount < 1
[[nodiscard]] Surface crop(const Surface& surface, double amount, std::uint64_t seed);

} // namespace vcg_ext
