// SPDX-License-Identifier: GPL-3.0-or-later
#include "centre.h"

#include "../base/error.h"
#include "../base/parallel.h"
#include "../base/prefetch.h"

namespace vcg_ext {

namespace {

/// Sum of A and of A (a + b + c) over triangles; about a point nearby, so that far is not inexact.
struct Moments {
    double area = 0;
    Point first = Point::Zero();

    Moments& operator+=(const Moments& other)
    {
        area += other.area;
        first += other.first;
        return *this;
    }
};

Moments moments_about(const Point& near, const Points& points, const std::vector<Triangle>& triangles)
{
    return ordered_sum(static_cast<int>(triangles.size()), Moments(), [&](int f) {
        prefetch_corners(points, triangles, f);
        const Point& a = points[triangles[f][0]];
        const Point to_b = points[triangles[f][1]] - a;
        const Point to_c = points[triangles[f][2]] - a;
        const double area = to_b.cross(to_c).norm();
        return Moments{area, area * (3 * (a - near) + to_b + to_c)};
    });
}

} // namespace

Point area_centre(const Points& points, const std::vector<Triangle>& triangles, const std::vector<Triangle>& fans)
{
    if (triangles.empty())
        throw Error("The mesh has no faces, so it has no surface to mark. Reconstruct the surface first.");
    const Point& near = points[triangles[0][0]];
    Moments sum = moments_about(near, points, triangles);
    sum += moments_about(near, points, fans);
    if (!(sum.area > 0))
        throw Error("No face of the mesh has an area. Check its coordinates, or reconstruct the surface.");
    return near + sum.first / (3 * sum.area);
}

} // namespace vcg_ext
