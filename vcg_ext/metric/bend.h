// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// The largest angle, in degrees, between two faces of the moved surface that share an edge and were coplanar before,
/// within a tenth of a degree: how far planes no longer are. 0 where no faces were.
/// \param normals unit normals of the faces before; zero where a face has no area
[[nodiscard]] double largest_bend(const Points& normals, const Points& after, const std::vector<Triangle>& triangles,
                                  const VertexFaces& around);

} // namespace vcg_ext
