// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "edge_graph.h"

namespace vcg_ext {

/// Row `v` of the combinatorial Laplacian (3.12) times `x`: degree times x(v) less the sum over the neighbours. The
/// graph implies its entries: the degree on the diagonal, -1 per neighbour.
/// \param x a matrix of Eigen's per vertex
template <class Value>
[[nodiscard]] Value laplacian_row(const EdgeGraph& graph, const std::vector<Value>& x, int v)
{
    Value sum = graph.degree(v) * x[v];
    for (const int* w = graph.begin(v); w != graph.end(v); ++w)
        sum -= x[*w];
    return sum;
}

/// An upper bound of the Laplacian's eigenvalues: the largest d(i) + d(j) over the edges (Anderson and Morley 1985).
[[nodiscard]] double laplacian_bound(const EdgeGraph& graph);

} // namespace vcg_ext
