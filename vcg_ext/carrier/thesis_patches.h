// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "patches.h"

namespace vcg_ext {

/// Cuts as the thesis prints it: trim (3.6) and layers (3.9) by range, then Algorithm 1, vertex by vertex along axis 1.
/// Its one slip is put right: the leftover at a layer's end takes no number from the next layer.
/// \return `layers` is 1 and `columns` the number of full patches, which may differ from `count` by a few
/// \throw Error where the surface has no area, and so no frame
[[nodiscard]] Patches thesis_patches(const Points& points, const SolidTopology& topology, const Frame& frame,
                                     int layers, int count, double trim);

} // namespace vcg_ext
