// SPDX-License-Identifier: GPL-3.0-or-later
#include "bend.h"

#include "../base/parallel.h"
#include "../base/pi.h"
#include "../geometry/normals.h"

#include <algorithm>
#include <cmath>

namespace vcg_ext {

namespace {

constexpr double degree = pi / 180;

bool has(const Triangle& t, int v)
{
    return std::find(t.begin(), t.end(), v) != t.end();
}

} // namespace

double largest_bend(const Points& normals, const Points& after, const std::vector<Triangle>& triangles,
                    const VertexFaces& around)
{
    const double coplanar = std::cos(0.1 * degree);
    const Points now = face_normals(after, triangles);
    const double most = ordered_maximum(static_cast<int>(triangles.size()), -1.0, [&](int f) {
        const Triangle& t = triangles[f];
        double largest = -1; // of minus the cosines
        for (int k = 0; k < 3; ++k)
            for (const int* g = around.begin(t[k]); g != around.end(t[k]); ++g)
                if (*g > f && has(triangles[*g], t[(k + 1) % 3]) && normals[f].dot(normals[*g]) > coplanar)
                    largest = std::max(largest, -now[f].dot(now[*g]));
        return largest;
    });
    return std::acos(std::clamp(-most, -1.0, 1.0)) / degree;
}

} // namespace vcg_ext
