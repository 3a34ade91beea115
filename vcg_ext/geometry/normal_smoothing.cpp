// SPDX-License-Identifier: GPL-3.0-or-later
#include "normal_smoothing.h"

#include "../base/parallel.h"

namespace vcg_ext {

Points smoothed_along_normals(const Surface& surface, const VertexFaces& around, int rounds, double weight)
{
    Points points = surface.points;
    for (int round = 0; round < rounds; ++round) {
        const Points before = points;
        for_each_index(static_cast<int>(points.size()), [&](int v) {
            Point normal = Point::Zero();
            Point neighbours = Point::Zero(); // each counts once for every face it shares with v
            for (const int* f = around.begin(v); f != around.end(v); ++f) {
                const Triangle& t = surface.triangles[*f];
                normal += scaled_normal(before, t);
                neighbours += before[t[0]] + before[t[1]] + before[t[2]] - before[v];
            }
            const double square = normal.squaredNorm();
            if (square > 0)
                points[v] += weight * normal * (normal.dot(neighbours / (2 * around.count(v)) - before[v]) / square);
        });
    }
    return points;
}

} // namespace vcg_ext
