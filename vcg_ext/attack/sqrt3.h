// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/error.h"
#include "../base/progress.h"
#include "../base/surface.h"

namespace vcg_ext {

/// Square root of three subdivision (Kobbelt 2000), `iterations` times: a vertex in the middle of every face, every edge
/// of two faces turned to join their middles, and the old vertices relaxed; three times the faces. Borders stay.
/// \param surface a welded one
[[nodiscard]] Surface subdivide_by_sqrt3(const Surface& surface, int iterations, const Progress& progress = {});

} // namespace vcg_ext
