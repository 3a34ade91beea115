// SPDX-License-Identifier: GPL-3.0-or-later
#include "edge_graph.h"

#include <algorithm>

namespace vcg_ext {

EdgeGraph edge_graph(const Surface& surface)
{
    const int vertices = static_cast<int>(surface.points.size());
    const VertexFaces around = vertex_faces(vertices, surface.triangles);
    EdgeGraph graph;
    graph.first.reserve(vertices + 1);
    graph.neighbour.reserve(3 * surface.triangles.size());
    graph.first.push_back(0);
    for (int v = 0; v < vertices; ++v) {
        for (const int* f = around.begin(v); f != around.end(v); ++f)
            for (const int w : surface.triangles[*f])
                if (w != v)
                    graph.neighbour.push_back(w);
        const auto row = graph.neighbour.begin() + graph.first.back();
        std::sort(row, graph.neighbour.end());
        graph.neighbour.erase(std::unique(row, graph.neighbour.end()), graph.neighbour.end());
        graph.first.push_back(static_cast<int>(graph.neighbour.size()));
    }
    return graph;
}

} // namespace vcg_ext
