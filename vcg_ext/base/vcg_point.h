// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "surface.h"

#include <vcg/space/point3.h>

namespace vcg_ext {

/// A point as vcglib has it.
[[nodiscard]] inline vcg::Point3d to_vcg(const Point& p)
{
    return {p.x(), p.y(), p.z()};
}

/// A point of vcglib as the library has it.
[[nodiscard]] inline Point from_vcg(const vcg::Point3d& p)
{
    return {p[0], p[1], p[2]};
}

} // namespace vcg_ext
