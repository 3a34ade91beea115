// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/error.h"
#include "../base/progress.h"
#include "../base/surface.h"

namespace vcg_ext {

/// Splits every face in four at the midpoints of its edges (vcglib), `iterations` times. The shape stays the same.
/// \param surface a welded one; edges of more than two faces are no obstacle
[[nodiscard]] Surface subdivide(const Surface& surface, int iterations, const Progress& progress = {});

} // namespace vcg_ext
