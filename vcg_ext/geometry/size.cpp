// SPDX-License-Identifier: GPL-3.0-or-later
#include "size.h"

#include "../base/parallel.h"

namespace vcg_ext {

std::vector<double> doubled_areas(const Points& points, const std::vector<Triangle>& triangles)
{
    std::vector<double> areas(triangles.size());
    for_each_index(static_cast<int>(triangles.size()),
                   [&](int f) { areas[f] = scaled_normal(points, triangles[f]).norm(); });
    return areas;
}

double surface_area(const Surface& surface)
{
    return ordered_sum(static_cast<int>(surface.triangles.size()), 0.0,
                       [&](int f) { return scaled_normal(surface.points, surface.triangles[f]).norm(); }) /
           2;
}

double mean_edge_length(const Surface& surface)
{
    if (surface.triangles.empty())
        return 0;
    const double sum = ordered_sum(static_cast<int>(surface.triangles.size()), 0.0, [&](int f) {
        const Triangle& t = surface.triangles[f];
        return (surface.points[t[0]] - surface.points[t[1]]).norm() +
               (surface.points[t[1]] - surface.points[t[2]]).norm() +
               (surface.points[t[2]] - surface.points[t[0]]).norm();
    });
    return sum / (3.0 * static_cast<double>(surface.triangles.size()));
}

} // namespace vcg_ext
