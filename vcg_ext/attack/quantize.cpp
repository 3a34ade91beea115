#include "quantize.h"

#include <cmath>

namespace vcg_ext {

Points quantize(const Points& points, int bits)
{
    Points result = points;
    if (points.empty())
        return result;
    Point low = points[0];
    Point high = points[0];
    for (const Point& p : points) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const double steps = std::ldexp(1.0, bits) - 1;
    for (Point& p : result)
        for (int axis = 0; axis < 3; ++axis)
            if (const double extent = high[axis] - low[axis]; extent > 0)
                p[axis] = low[axis] + std::floor((p[axis] - low[axis]) / extent * steps + 0.5) * (extent / steps);
    return result;
}

} // namespace vcg_ext
