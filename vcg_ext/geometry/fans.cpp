// SPDX-License-Identifier: GPL-3.0-or-later
#include "fans.h"

#include "../base/parallel.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace vcg_ext {

namespace {

using Edge = std::pair<int, int>; ///< of a face, opposite to the vertex: from, to

/// Appends the fans that the edges chain up to; uses up `edges`.
void append_fans(std::vector<Edge>& edges, std::vector<int>& neighbours)
{
    constexpr std::size_t many = 32; // the search takes their square: they stay single faces
    const std::size_t count = edges.size();
    for (std::size_t next = 0; next < count;) {
        if (next > 0)
            neighbours.push_back(Fans::gap);
        neighbours.push_back(edges[next].first);
        int end = edges[next++].second;
        neighbours.push_back(end);
        while (count <= many) {
            const auto found = std::find_if(edges.begin() + static_cast<std::ptrdiff_t>(next), edges.end(),
                                            [end](const Edge& e) { return e.first == end; });
            if (found == edges.end())
                break;
            std::swap(*found, edges[next]);
            end = edges[next++].second;
            neighbours.push_back(end);
        }
    }
}

} // namespace

Fans fans_of(const VertexFaces& around, const std::vector<Triangle>& triangles)
{
    constexpr int chunk = 4096;
    const int vertices = static_cast<int>(around.first.size()) - 1;
    Fans fans;
    fans.first.assign(vertices + 1, 0);
    std::vector<std::vector<int>> parts(chunk_count(vertices, chunk));
    for_chunks(vertices, chunk, [&](int begin, int end) {
        std::vector<int>& part = parts[begin / chunk];
        part.reserve(8 * (end - begin));
        std::vector<Edge> edges;
        for (int v = begin; v < end; ++v) {
            edges.clear();
            for (const int* f = around.begin(v); f != around.end(v); ++f) {
                const Triangle& t = triangles[*f];
                const int corner = t[0] == v ? 0 : t[1] == v ? 1 : 2;
                edges.emplace_back(t[(corner + 1) % 3], t[(corner + 2) % 3]);
            }
            const std::size_t before = part.size();
            append_fans(edges, part);
            fans.first[v + 1] = static_cast<int>(part.size() - before);
        }
    });
    std::partial_sum(fans.first.begin(), fans.first.end(), fans.first.begin());
    fans.neighbour.resize(fans.first.back());
    for_chunks(vertices, chunk, [&](int begin, int) {
        std::vector<int>& part = parts[begin / chunk];
        std::copy(part.begin(), part.end(), fans.neighbour.begin() + fans.first[begin]);
        part = {};
    });
    return fans;
}

} // namespace vcg_ext
