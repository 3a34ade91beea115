// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "vcg_ext/geometry/fast_marching.h"

namespace vcg_ext {

/// When and from where the front reaches each vertex.
[[nodiscard]] inline std::vector<Arrival> march(const Surface& surface, const VertexFaces& around,
                                                const SurfacePoint& source)
{
    const std::vector<double> distances =
        distances_from(source, surface.points, surface.triangles, fans_of(around, surface.triangles));
    return arrivals_of(distances, source, surface, around);
}

} // namespace vcg_ext
