// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

#include <cstdint>

namespace vcg_ext {

/// So many copies side by side along x as a printer's plate has them, each turned by a random angle about z; none
/// touches another.
[[nodiscard]] Surface plate(const Surface& surface, int copies, std::uint64_t seed);

} // namespace vcg_ext
