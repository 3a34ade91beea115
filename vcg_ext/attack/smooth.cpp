// SPDX-License-Identifier: GPL-3.0-or-later
#include "smooth.h"

#include "../base/progress.h"
#include "../base/weld.h"
#include "../geometry/umbrella.h"

namespace vcg_ext {

Points smooth(const Surface& surface, double lambda, int iterations, const Progress& progress)
{
    const Welded welded = weld(surface);
    const EdgeGraph graph = edge_graph(welded.surface);
    Points points = welded.surface.points;
    for (int i = 0; i < iterations; ++i) {
        report(progress, 100 * i / iterations, "Smoothing");
        points = umbrella_step(graph, points, lambda);
    }
    return unweld(surface.points, welded.site_of_vertex, points);
}

} // namespace vcg_ext
