// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "laplacian.h"
#include "wavefront.h"

#include <array>
#include <utility>

namespace vcg_ext {

/// Steps of Laplacian smoothing with uniform weights: in each every vertex goes a part of the way to the mean of its
/// neighbours, all at once. Vertices without neighbours stay.
///
/// \param values a point per vertex, or a matrix of several side by side, which takes little longer than one
/// \param part `part(step)`, steps from 0 on: in (0, 1] to smooth, negative to inflate
template <class Value, class Part>
[[nodiscard]] std::vector<Value> umbrella_series(const EdgeGraph& graph, std::vector<Value> values, int steps,
                                                 const Part& part)
{
    std::array<std::vector<Value>, 2> turns{std::move(values), {}};
    turns[1].resize(steps > 0 ? turns[0].size() : 0);
    take_steps(graph, 0, steps, [&](int step, int begin, int end) {
        const std::vector<Value>& now = turns[step % 2];
        std::vector<Value>& next = turns[(step + 1) % 2];
        const double way = part(step);
        for (int v = begin; v < end; ++v) {
            const int degree = graph.degree(v);
            next[v] = now[v];
            if (degree > 0)
                next[v] -= way / degree * laplacian_row(graph, now, v);
        }
    });
    return std::move(turns[steps % 2]);
}

/// The same with one part for all steps.
template <class Value>
[[nodiscard]] std::vector<Value> umbrella_steps(const EdgeGraph& graph, std::vector<Value> values, double part,
                                                int steps)
{
    return umbrella_series(graph, std::move(values), steps, [part](int) { return part; });
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
