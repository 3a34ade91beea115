// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// The graph of a surface's edges, as compressed rows: the neighbours of `v` are
/// `neighbour[first[v]] .. neighbour[first[v + 1] - 1]`, each once, in ascending order.
struct EdgeGraph {
    std::vector<int> first;     ///< one more than there are vertices
    std::vector<int> neighbour; ///< twice as many as there are edges

    [[nodiscard]] int vertices() const { return static_cast<int>(first.size()) - 1; }
    [[nodiscard]] int degree(int v) const { return first[v + 1] - first[v]; }
    [[nodiscard]] const int* begin(int v) const { return neighbour.data() + first[v]; }
    [[nodiscard]] const int* end(int v) const { return neighbour.data() + first[v + 1]; }
};

[[nodiscard]] EdgeGraph edge_graph(const Surface& surface);
/// \param around of the triangles
[[nodiscard]] EdgeGraph edge_graph(const VertexFaces& around, const std::vector<Triangle>& triangles);

/// The vertices that are at most `rings` edges away from one of `vertices`, ascending.
[[nodiscard]] std::vector<int> within_rings(const EdgeGraph& graph, std::vector<int> vertices, int rings);

/// The graph of some vertices, numbered as they stand there, and the edges between them.
/// \param vertices ascending
[[nodiscard]] EdgeGraph part_of(const EdgeGraph& graph, const std::vector<int>& vertices);

} // namespace vcg_ext
