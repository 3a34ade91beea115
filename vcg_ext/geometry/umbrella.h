// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/parallel.h"
#include "laplacian.h"

namespace vcg_ext {

/// Steps of Laplacian smoothing with uniform weights: in each every vertex goes the part `part` of the way to the mean
/// of its neighbours, all at once. Vertices without neighbours stay.
///
/// \param values a point per vertex, or a matrix of several side by side, which takes little longer than one
/// \param part in (0, 1] to smooth, negative to inflate
template <class Value>
[[nodiscard]] std::vector<Value> umbrella_steps(const EdgeGraph& graph, std::vector<Value> values, double part,
                                                int steps)
{
    std::vector<Value> moved(values.size());
    for (int step = 0; step < steps; ++step) {
        for_each_index(graph.vertices(), [&](int v) {
            const int degree = graph.degree(v);
            moved[v] = values[v];
            if (degree > 0)
                moved[v] -= part / degree * laplacian_row(graph, values, v);
        });
        values.swap(moved);
    }
    return values;
}

/// One such step.
template <class Value>
[[nodiscard]] std::vector<Value> umbrella_step(const EdgeGraph& graph, std::vector<Value> values, double part)
{
    return umbrella_steps(graph, std::move(values), part, 1);
}

/// Low-pass without shrinking (Taubin 1995): in each pass one step of `shrink`, then one of `inflate`.
///
/// \param shrink in (0, 1)
/// \param inflate below -shrink
[[nodiscard]] Points taubin(const EdgeGraph& graph, Points points, int passes, double shrink = 0.5,
                            double inflate = -0.53);

} // namespace vcg_ext
