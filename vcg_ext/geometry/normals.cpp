// SPDX-License-Identifier: GPL-3.0-or-later
#include "normals.h"

#include "../base/parallel.h"

namespace vcg_ext {

Points face_normals(const Points& points, const std::vector<Triangle>& triangles)
{
    Points normals(triangles.size());
    for_each_index(static_cast<int>(triangles.size()), [&](int f) {
        const Point n = scaled_normal(points, triangles[f]);
        const double length = n.norm();
        normals[f] = length > 0 ? Point(n / length) : Point(Point::Zero());
    });
    return normals;
}

Points vertex_normals(const Points& points, const std::vector<Triangle>& triangles)
{
    Points normals(points.size(), Point::Zero());
    for (const Triangle& t : triangles) {
        const Point n = scaled_normal(points, t);
        for (const int v : t)
            normals[v] += n;
    }
    for (Point& n : normals)
        n.normalize();
    return normals;
}

} // namespace vcg_ext
