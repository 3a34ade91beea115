#include "shells.h"

#include "../base/error.h"
#include "../base/parallel.h"
#include "../geometry/centre.h"

#include <algorithm>

namespace vcg_ext {

std::vector<double> norms(const Points& points, const Point& centre)
{
    std::vector<double> result(points.size());
    for_each_index(static_cast<int>(points.size()), [&](int v) { result[v] = (points[v] - centre).norm(); });
    return result;
}

Shells shells(const Points& points, const std::vector<Triangle>& triangles, double trim, int count)
{
    Shells result;
    result.centre = area_centre(points, triangles);
    result.norms = norms(points, result.centre);
    const auto [low, high] = std::minmax_element(result.norms.begin(), result.norms.end());
    result.minimum = *low;
    result.maximum = *high;
    if (!(result.maximum - result.minimum > 1e-9 * result.maximum))
        throw Error("All vertices are equally far from the mesh's centre, so their distances cannot carry a message. "
                    "Use another method, or another mesh.");
    result.carriers = cut_range(result.norms, result.minimum, result.maximum, trim, count);
    return result;
}

} // namespace vcg_ext
