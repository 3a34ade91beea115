// SPDX-License-Identifier: GPL-3.0-or-later
#include "renumber.h"

#include "../base/parallel.h"

#include <algorithm>

namespace vcg_ext {

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

void renumber(Surface& surface, std::vector<int>& site_of_vertex, const std::vector<int>& order)
{
    const int sites = static_cast<int>(surface.points.size());
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
    for (int& site : site_of_vertex)
        if (site >= 0)
            site = number[site];
}

} // namespace vcg_ext
