// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// Twice the area of each face.
[[nodiscard]] std::vector<double> doubled_areas(const Points& points, const std::vector<Triangle>& triangles);

/// The area of all faces.
[[nodiscard]] double surface_area(const Surface& surface);

/// Mean length of the faces' edges, an edge of two faces counted twice; 0 where there are none.
[[nodiscard]] double mean_edge_length(const Surface& surface);

} // namespace vcg_ext
