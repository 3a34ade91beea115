// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

#include <cstdint>

namespace vcg_ext {

/// Vertices and faces in random order, each face beginning at a random corner. The geometry is the same bit for bit.
[[nodiscard]] Surface reorder(const Surface& surface, std::uint64_t seed);

} // namespace vcg_ext
