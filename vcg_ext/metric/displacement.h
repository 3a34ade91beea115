// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// Largest distance between a point and its counterpart.
[[nodiscard]] double max_displacement(const Points& before, const Points& after);

/// How many points differ from their counterparts.
[[nodiscard]] int moved_count(const Points& before, const Points& after);

/// Root mean square distance between a surface and its moved copy, the larger of both directions, as
/// Metro's MRMS (2.16).
///
/// For moves smaller than the faces: distances are measured to the faces around the sample's own, never less than the
/// true ones. On all of up to 65,535 faces; on 32,768 to 49,151 of more, evenly chosen: up to 6 % above Metro on marked
/// meshes, in a fraction of its time. For any pair of surfaces see distortion.h.
[[nodiscard]] double local_mrms(const Points& before, const Points& after, const std::vector<Triangle>& triangles,
                                const VertexFaces& around);

} // namespace vcg_ext
