// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// Where (5.21) and Cho start: `v` moved along the ray from `centre` to the distance `norm`.
[[nodiscard]] inline Point radial_point(const Point& v, const Point& centre, double norm)
{
    return centre + (v - centre) * (norm / (v - centre).norm());
}

} // namespace vcg_ext
