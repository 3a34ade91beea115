// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// Unit normals of all faces; zero where a face has no area.
[[nodiscard]] Points face_normals(const Points& points, const std::vector<Triangle>& triangles);

/// Unit normals of all vertices: the mean of the faces around, weighted by area; zero where these have none.
[[nodiscard]] Points vertex_normals(const Points& points, const std::vector<Triangle>& triangles);

} // namespace vcg_ext
