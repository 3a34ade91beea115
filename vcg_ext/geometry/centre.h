// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// Area-weighted mean of the vertices (5.1).
/// \param fans further triangles  \throw Error where no face has an area
[[nodiscard]] Point area_centre(const Points& points, const std::vector<Triangle>& triangles,
                                const std::vector<Triangle>& fans = {});

} // namespace vcg_ext
