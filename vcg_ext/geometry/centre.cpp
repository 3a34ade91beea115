// SPDX-License-Identifier: GPL-3.0-or-later
#include "centre.h"

#include "../base/error.h"
#include "../base/parallel.h"

namespace vcg_ext {

Point area_centre(const Points& points, const std::vector<Triangle>& triangles)
{
    using Moments = Eigen::Vector4d; // sum A (a + b + c) / 3 and sum A; about a corner, so that far is not inexact
    if (triangles.empty())
        throw Error("The mesh has no faces, so it has no surface to mark. Reconstruct the surface first.");
    const Point near = points[triangles[0][0]];
    const Moments sum = ordered_sum(static_cast<int>(triangles.size()), Moments(Moments::Zero()), [&](int f) {
        const Triangle& t = triangles[f];
        const double area = scaled_normal(points, t).norm();
        Moments moments;
        moments << area * ((points[t[0]] - near) + (points[t[1]] - near) + (points[t[2]] - near)) / 3, area;
        return moments;
    });
    if (!(sum[3] > 0))
        throw Error("No face of the mesh has an area. Check its coordinates, or reconstruct the surface.");
    return near + sum.head<3>() / sum[3];
}

} // namespace vcg_ext
