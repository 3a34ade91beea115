// SPDX-License-Identifier: GPL-3.0-or-later
#include "fans.h"

#include "rows.h"

#include <algorithm>
#include <utility>

namespace vcg_ext {

namespace {

using Opposite = std::pair<int, int>; ///< the edge of a face that is not at the vertex: from, to

/// Appends the fans that the edges chain up to; uses up `edges`.
void append_fans(std::vector<Opposite>& edges, std::vector<int>& neighbours)
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
                                            [end](const Opposite& e) { return e.first == end; });
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
    CompressedRows rows =
        compressed_rows(static_cast<int>(around.first.size()) - 1, 8, [&](int v, std::vector<int>& neighbours) {
            thread_local std::vector<Opposite> edges; // keeps its memory
            edges.clear();
            for (const int* f = around.begin(v); f != around.end(v); ++f) {
                const Triangle& t = triangles[*f];
                const int corner = t[0] == v ? 0 : t[1] == v ? 1 : 2;
                edges.emplace_back(t[(corner + 1) % 3], t[(corner + 2) % 3]);
            }
            append_fans(edges, neighbours);
        });
    return {std::move(rows.first), std::move(rows.numbers)};
}

} // namespace vcg_ext
