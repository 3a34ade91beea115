// SPDX-License-Identifier: GPL-3.0-or-later
#include "rings.h"

#include "../base/parallel.h"

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

namespace {

/// By the lowest corner; equal ones stay in their order.
std::vector<Triangle> by_first_corner(const std::vector<Triangle>& triangles, int vertices)
{
    const auto lowest = [](const Triangle& t) { return std::min({t[0], t[1], t[2]}); };
    std::vector<int> place(vertices + 1, 0);
    for (const Triangle& t : triangles)
        ++place[lowest(t) + 1];
    for (int v = 0; v < vertices; ++v)
        place[v + 1] += place[v];
    std::vector<Triangle> sorted(triangles.size());
    for (const Triangle& t : triangles)
        sorted[place[lowest(t)]++] = t;
    return sorted;
}

} // namespace

void number_by_rings(Body& body)
{
    Surface& surface = body.surface;
    const int sites = static_cast<int>(surface.points.size());
    const std::vector<int> order = ring_order(sites, surface.triangles);
    std::vector<int> number(sites);
    Points points(sites);
    for_each_index(sites, [&](int i) {
        number[order[i]] = i;
        points[i] = surface.points[order[i]];
    });
    surface.points = std::move(points);
    for_each_index(static_cast<int>(surface.triangles.size()), [&](int f) {
        for (int& v : surface.triangles[f])
            v = number[v];
    });
    surface.triangles = by_first_corner(surface.triangles, sites);
    for (int& site : body.site_of_vertex)
        if (site >= 0)
            site = number[site];
}

} // namespace vcg_ext
