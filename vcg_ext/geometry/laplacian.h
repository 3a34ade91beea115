#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// The graph of a surface's edges, as compressed rows: neighbours of `v` are `neighbour[first[v]] .. neighbour[first[v
/// + 1] - 1]`, ascending, each once. It stands for the combinatorial Laplacian (3.12), whose entries it implies: the
/// degree on the diagonal, -1 per neighbour.
struct EdgeGraph {
    std::vector<int> first;     ///< one more than there are vertices
    std::vector<int> neighbour; ///< twice as many as there are edges

    [[nodiscard]] int vertices() const { return static_cast<int>(first.size()) - 1; }
    [[nodiscard]] int degree(int v) const { return first[v + 1] - first[v]; }
    [[nodiscard]] const int* begin(int v) const { return neighbour.data() + first[v]; }
    [[nodiscard]] const int* end(int v) const { return neighbour.data() + first[v + 1]; }
};

[[nodiscard]] EdgeGraph edge_graph(const Surface& surface);

/// Row `v` of the combinatorial Laplacian times `x`: degree times x(v) less the sum over the neighbours.
[[nodiscard]] inline Point laplacian_row(const EdgeGraph& graph, const Points& x, int v)
{
    Point sum = graph.degree(v) * x[v];
    for (const int* w = graph.begin(v); w != graph.end(v); ++w)
        sum -= x[*w];
    return sum;
}

/// An upper bound of the Laplacian's eigenvalues: the largest d(i) + d(j) over the edges (Anderson and Morley 1985).
[[nodiscard]] double laplacian_bound(const EdgeGraph& graph);

} // namespace vcg_ext
