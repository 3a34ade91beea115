// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/error.h"
#include "../base/progress.h"
#include "../base/surface.h"

namespace vcg_ext {

/// Quadric edge collapse by vcglib with MeshLab's usual settings (optimal placement, quality threshold 0.3, borders
/// kept by quadrics, topology free to change), until no more than `faces` faces are left.
///
/// \param surface a welded one
/// \throw Error where the collapses end before that
[[nodiscard]] Surface simplify(const Surface& surface, int faces, const Progress& progress = {});

} // namespace vcg_ext
