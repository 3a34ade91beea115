// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/error.h"
#include "../base/progress.h"
#include "../base/surface.h"

namespace vcg_ext {

/// Loop's subdivision (1987, vcglib's): every face in four, `iterations` times, old and new vertices at the weighted
/// means that make the surface smooth; a border becomes a spline of its own.
///
/// \param surface a welded one
/// \throw Error where an edge has more than two faces
[[nodiscard]] Surface subdivide_by_loop(const Surface& surface, int iterations, const Progress& progress = {});

} // namespace vcg_ext
