// SPDX-License-Identifier: GPL-3.0-or-later
#include "quantize.h"

#include <cmath>

namespace vcg_ext {

Points quantize(const Points& points, int bits)
{
    Points result = points;
    const Eigen::AlignedBox3d box = bounding_box(points);
    const Point& low = box.min();
    const Point& high = box.max();
    const double steps = std::ldexp(1.0, bits) - 1;
    for (Point& p : result)
        for (int axis = 0; axis < 3; ++axis)
            if (const double extent = high[axis] - low[axis]; extent > 0)
                p[axis] = low[axis] + std::floor((p[axis] - low[axis]) / extent * steps + 0.5) * (extent / steps);
    return result;
}

} // namespace vcg_ext
