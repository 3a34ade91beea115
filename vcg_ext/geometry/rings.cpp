// SPDX-License-Identifier: GPL-3.0-or-later
#include "rings.h"

#include "renumber.h"

#include <algorithm>

namespace vcg_ext {

std::vector<int> ring_order(int vertices, const std::vector<Triangle>& triangles)
{
    const VertexFaces around = vertex_faces(vertices, triangles);
    std::vector<char> seen(vertices, 0);
    std::vector<int> order;
    order.reserve(vertices);
    const auto visit = [&](int v) {
        if (!seen[v])
            order.push_back(v);
        seen[v] = 1;
    };
    std::size_t next = 0;
    for (int first = 0; first < vertices; ++first) {
        visit(first);
        for (; next < order.size(); ++next)
            std::for_each(around.begin(order[next]), around.end(order[next]), [&](int f) {
                for (const int w : triangles[f])
                    visit(w);
            });
    }
    return order;
}

void number_by_rings(Body& body)
{
    renumber(body, ring_order(static_cast<int>(body.surface.points.size()), body.surface.triangles));
}

} // namespace vcg_ext
