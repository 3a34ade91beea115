// SPDX-License-Identifier: GPL-3.0-or-later
#include "normal_smoothing.h"

#include "../base/parallel.h"

namespace vcg_ext {

Points smoothed_along_normals(Points points, const Fans& fans, int rounds, double weight)
{
    Points before(rounds > 0 ? points.size() : 0);
    for (int round = 0; round < rounds; ++round) {
        points.swap(before);
        for_each_index(fans.vertices(), [&](int v) {
            Point normal = Point::Zero();
            Point steps = Point::Zero(); // to the neighbours, each once for every face it shares with v
            int count = 0;
            Point last = Point::Zero();
            bool begins = true;
            for (const int* w = fans.begin(v); w != fans.end(v); ++w) {
                if (*w == Fans::gap) {
                    begins = true;
                    continue;
                }
                const Point step = before[*w] - before[v];
                if (!begins) {
                    normal += last.cross(step);
                    steps += last + step;
                    count += 2;
                }
                last = step;
                begins = false;
            }
            const double square = normal.squaredNorm();
            points[v] = before[v];
            if (square > 0)
                points[v] += weight * normal * (normal.dot(steps) / (count * square));
        });
    }
    return points;
}

} // namespace vcg_ext
