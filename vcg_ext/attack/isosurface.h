// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/error.h"
#include "../base/progress.h"
#include "../base/surface.h"

namespace vcg_ext {

/// The surface anew, by marching cubes (vcglib) over the signed distance to it, in cubes of edge `cell`.
///
/// A place is inside where a ray from it crosses the surface an odd number of times. That needs no normals and no
/// orientation, only that every edge has an even number of faces. The result is closed and two-manifold.
///
/// \param surface a welded one
/// \throw Error where an edge has an odd number of faces (a border), or the cells are too coarse to hold the surface
[[nodiscard]] Surface isosurface(const Surface& surface, double cell, const Progress& progress = {});

} // namespace vcg_ext
