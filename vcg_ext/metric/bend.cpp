// SPDX-License-Identifier: GPL-3.0-or-later
#include "bend.h"

#include "../base/parallel.h"

#include <algorithm>
#include <cmath>

namespace vcg_ext {

namespace {

constexpr double degree = 3.14159265358979323846 / 180;

/// Angle between the faces' normals, in degrees; 0 where one has none.
double angle(const Points& points, const Triangle& a, const Triangle& b)
{
    const Point m = scaled_normal(points, a);
    const Point n = scaled_normal(points, b);
    return std::atan2(m.cross(n).norm(), m.dot(n)) / degree;
}

bool has(const Triangle& t, int v)
{
    return std::find(t.begin(), t.end(), v) != t.end();
}

} // namespace

double largest_bend(const Points& before, const Points& after, const std::vector<Triangle>& triangles,
                    const VertexFaces& around)
{
    constexpr double coplanar = 0.1;
    return ordered_maximum(static_cast<int>(triangles.size()), 0.0, [&](int f) {
        const Triangle& t = triangles[f];
        double largest = 0;
        for (int k = 0; k < 3; ++k)
            for (const int* g = around.begin(t[k]); g != around.end(t[k]); ++g)
                if (*g > f && has(triangles[*g], t[(k + 1) % 3]) && angle(before, t, triangles[*g]) < coplanar)
                    largest = std::max(largest, angle(after, t, triangles[*g]));
        return largest;
    });
}

} // namespace vcg_ext
