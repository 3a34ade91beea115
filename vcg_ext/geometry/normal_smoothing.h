// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "fans.h"

namespace vcg_ext {

/// Smooths the shape and keeps the sampling: each vertex moves along its normal (area-weighted) by `weight` of the way
/// that Laplacian smoothing would take it, and not along the surface.
///
/// \param fans of the surface's triangles
/// \param weight in (0, 1]
/// \return the positions after `rounds` rounds
[[nodiscard]] Points smoothed_along_normals(Points points, const Fans& fans, int rounds, double weight);

} // namespace vcg_ext
