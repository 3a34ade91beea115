// SPDX-License-Identifier: GPL-3.0-or-later
#include "smooth.h"

#include "../base/progress.h"
#include "../base/weld.h"
#include "../geometry/umbrella.h"

namespace vcg_ext {

namespace {

/// \param step `step(graph, points)`: the points after one more
template <class Step>
Points repeated(const Surface& surface, int iterations, const Step& step, const Progress& progress)
{
    const Welded welded = weld(surface);
    const EdgeGraph graph = edge_graph(welded.surface);
    Points points = welded.surface.points;
    for (int i = 0; i < iterations; ++i) {
        report(progress, 100 * i / iterations, "Smoothing");
        points = step(graph, points);
    }
    return unweld(surface.points, welded.site_of_vertex, points);
}

} // namespace

Points smooth(const Surface& surface, double lambda, int iterations, const Progress& progress)
{
    const auto step = [&](const EdgeGraph& graph, const Points& points) {
        return umbrella_step(graph, points, lambda);
    };
    return repeated(surface, iterations, step, progress);
}

Points smooth_by_taubin(const Surface& surface, double lambda, int iterations, const Progress& progress)
{
    const auto step = [&](const EdgeGraph& graph, const Points& points) {
        return taubin(graph, points, 1, lambda, -1.06 * lambda);
    };
    return repeated(surface, iterations, step, progress);
}

} // namespace vcg_ext
