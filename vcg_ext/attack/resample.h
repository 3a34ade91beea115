// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/error.h"
#include "../base/progress.h"
#include "../base/surface.h"

namespace vcg_ext {

/// Uniform resampling to `vertices` vertices, within 1 %: new ones evenly spread over the surface, in a mesh that has
/// nothing to do with the old one.
///
/// The thesis spreads samples with a method of its reference [13]. Here it is isotropic remeshing to the edge length
/// that gives as many vertices or a few more, and quadric collapses for what is too many.
///
/// \param surface a welded one
/// \throw Error where the number cannot be reached, and as remesh()
[[nodiscard]] Surface resample(const Surface& surface, int vertices, const Progress& progress = {});

} // namespace vcg_ext
