// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

#include <optional>

namespace vcg_ext {

/// A point inside a face, its border included.
struct SurfacePoint {
    int face = -1;
    Point position = Point::Zero();
};

/// The intersection of a ray with the surface, from either side of a face, that is farthest from `origin`; of two faces
/// equally far the one with the lower number.
///
/// One pass over the faces. vcglib's spatial structures pay off from some ten rays on: for the first one, building its
/// box tree costs 20 passes, its grid 7 (and the grid's iterator misses a ray now and then).
///
/// \param direction any length but 0
/// \return nothing where the ray misses
[[nodiscard]] std::optional<SurfacePoint> farthest_hit(const Surface& surface, const Point& origin,
                                                       const Point& direction);

} // namespace vcg_ext
