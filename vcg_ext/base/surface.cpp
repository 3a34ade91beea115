// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface.h"

#include "parallel.h"

#include <numeric>
#include <utility>

namespace vcg_ext {

VertexFaces vertex_faces(int vertices, const std::vector<Triangle>& triangles)
{
    VertexFaces around;
    around.first.assign(vertices + 1, 0);
    for (const Triangle& t : triangles)
        for (const int v : t)
            ++around.first[v + 1];
    std::partial_sum(around.first.begin(), around.first.end(), around.first.begin());
    around.face.resize(3 * triangles.size());
    std::vector<int> next(around.first.begin(), around.first.end() - 1);
    for (std::size_t f = 0; f < triangles.size(); ++f)
        for (const int v : triangles[f])
            around.face[next[v]++] = static_cast<int>(f);
    return around;
}

void turn_round(Surface& surface)
{
    for (Triangle& t : surface.triangles)
        std::swap(t[1], t[2]);
}

Eigen::AlignedBox3d bounding_box(const Points& points)
{
    using Box = Eigen::AlignedBox3d;
    return ordered_fold(
        static_cast<int>(points.size()), Box(), [&](Box& box, int v) { box.extend(points[v]); },
        [](Box& box, const Box& part) { box.extend(part); });
}

Points copy_of(const Points& points)
{
    Points result(points.size());
    for_each_index(static_cast<int>(points.size()), [&](int v) { result[v] = points[v]; });
    return result;
}

Points rounded_to_float(const Points& points)
{
    Points result(points.size());
    for_each_index(static_cast<int>(points.size()), [&](int v) { result[v] = points[v].cast<float>().cast<double>(); });
    return result;
}

Eigen::AlignedBox3d bounding_box(const Points& points, const std::vector<Triangle>& triangles)
{
    using Box = Eigen::AlignedBox3d;
    return ordered_fold(
        static_cast<int>(triangles.size()), Box(),
        [&](Box& box, int f) {
            for (const int v : triangles[f])
                box.extend(points[v]);
        },
        [](Box& box, const Box& part) { box.extend(part); });
}

double bounding_diagonal(const Surface& surface)
{
    return surface.triangles.empty() ? 0 : bounding_box(surface).diagonal().norm();
}

} // namespace vcg_ext
