// SPDX-License-Identifier: GPL-3.0-or-later
#include "edge_graph.h"

#include "rows.h"

#include <algorithm>
#include <utility>

namespace vcg_ext {

EdgeGraph edge_graph(const Surface& surface)
{
    return edge_graph(vertex_faces(static_cast<int>(surface.points.size()), surface.triangles), surface.triangles);
}

EdgeGraph edge_graph(const VertexFaces& around, const std::vector<Triangle>& triangles)
{
    const int vertices = static_cast<int>(around.first.size()) - 1;
    CompressedRows rows = compressed_rows(vertices, 8, [&](int v, std::vector<int>& neighbours) {
        const auto begin = static_cast<std::ptrdiff_t>(neighbours.size());
        for (const int* f = around.begin(v); f != around.end(v); ++f)
            for (const int w : triangles[*f])
                if (w != v)
                    neighbours.push_back(w);
        const auto row = neighbours.begin() + begin;
        std::sort(row, neighbours.end());
        neighbours.erase(std::unique(row, neighbours.end()), neighbours.end());
    });
    return {std::move(rows.first), std::move(rows.numbers)};
}

std::vector<int> within_rings(const EdgeGraph& graph, std::vector<int> vertices, int rings)
{
    std::vector<char> seen(graph.vertices(), 0);
    for (const int v : vertices)
        seen[v] = 1;
    std::size_t begin = 0;
    for (int ring = 0; ring < rings; ++ring) {
        const std::size_t end = vertices.size();
        for (; begin < end; ++begin)
            for (const int *w = graph.begin(vertices[begin]), *last = graph.end(vertices[begin]); w != last; ++w) {
                if (!seen[*w])
                    vertices.push_back(*w);
                seen[*w] = 1;
            }
    }
    std::sort(vertices.begin(), vertices.end());
    return vertices;
}

EdgeGraph part_of(const EdgeGraph& graph, const std::vector<int>& vertices)
{
    std::vector<int> number(graph.vertices(), -1);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        number[vertices[i]] = static_cast<int>(i);
    EdgeGraph part;
    part.first.push_back(0);
    for (const int v : vertices) {
        for (const int* w = graph.begin(v); w != graph.end(v); ++w)
            if (number[*w] >= 0)
                part.neighbour.push_back(number[*w]);
        part.first.push_back(static_cast<int>(part.neighbour.size()));
    }
    return part;
}

} // namespace vcg_ext
