// SPDX-License-Identifier: GPL-3.0-or-later
#include "orient.h"

#include "boundary.h"

#include <utility>

namespace vcg_ext {

void orient_alike(Surface& surface)
{
    std::vector<Triangle>& triangles = surface.triangles;
    const VertexFaces around = vertex_faces(static_cast<int>(surface.points.size()), triangles);
    std::vector<std::vector<std::pair<int, bool>>> next(triangles.size()); // face, and whether it runs the other way
    for (const EdgeUse& e : paired_edges(surface)) {
        int at[2] = {0, 0};
        int count = 0;
        for (const int* f = around.begin(e.low); f != around.end(e.low) && count < 2; ++f)
            if (const Triangle& t = triangles[*f]; t[0] == e.high || t[1] == e.high || t[2] == e.high)
                at[count++] = *f;
        next[at[0]].emplace_back(at[1], e.balance != 0);
        next[at[1]].emplace_back(at[0], e.balance != 0);
    }
    std::vector<signed char> way(triangles.size(), 0);
    std::vector<int> component;
    for (std::size_t start = 0; start < triangles.size(); ++start) {
        if (way[start])
            continue;
        component.assign(1, static_cast<int>(start));
        way[start] = 1;
        double balance = 0;
        for (std::size_t i = 0; i < component.size(); ++i) {
            const int f = component[i];
            balance += way[f] * scaled_normal(surface.points, triangles[f]).norm();
            for (const auto& [other, turned] : next[f])
                if (!way[other]) {
                    way[other] = static_cast<signed char>(turned ? -way[f] : way[f]);
                    component.push_back(other);
                }
        }
        for (const int f : component)
            if (way[f] * balance < 0)
                std::swap(triangles[f][1], triangles[f][2]);
    }
}

} // namespace vcg_ext
