// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/error.h"
#include "../base/progress.h"
#include "../base/surface.h"

namespace vcg_ext {

/// Isotropic explicit remeshing (vcglib) with MeshLab's usual settings: in each iteration long edges are split, short
/// ones collapsed, valences evened out by flips, vertices moved along the surface and put back on the original. Edges
/// with a dihedral angle above 30 degrees stay.
///
/// \param surface a welded one
/// \param length the edge length to reach
/// \throw Error where nearly all faces lie in a small part of the bounding box, for then the searches take hours
[[nodiscard]] Surface remesh(const Surface& surface, double length, int iterations, const Progress& progress = {});

} // namespace vcg_ext
