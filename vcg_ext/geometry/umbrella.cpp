// SPDX-License-Identifier: GPL-3.0-or-later
#include "umbrella.h"

#include "../base/parallel.h"
#include "laplacian.h"

namespace vcg_ext {

Points umbrella_step(const EdgeGraph& graph, const Points& points, double part)
{
    Points moved(points.size());
    for_each_index(graph.vertices(), [&](int v) {
        const int degree = graph.degree(v);
        moved[v] = degree > 0 ? Point(points[v] - part / degree * laplacian_row(graph, points, v)) : points[v];
    });
    return moved;
}

Points umbrella_steps(const EdgeGraph& graph, Points points, double part, int steps)
{
    for (int step = 0; step < steps; ++step)
        points = umbrella_step(graph, points, part);
    return points;
}

Points taubin(const EdgeGraph& graph, Points points, int passes, double shrink, double inflate)
{
    for (int pass = 0; pass < passes; ++pass)
        for (const double part : {shrink, inflate})
            points = umbrella_step(graph, points, part);
    return points;
}

} // namespace vcg_ext
