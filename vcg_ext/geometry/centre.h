// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// Area-weighted mean of the vertices (5.1).
/// \throw Error where no face has an area
[[nodiscard]] Point area_centre(const Points& points, const std::vector<Triangle>& triangles);

} // namespace vcg_ext
