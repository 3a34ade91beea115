// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts.h"

#include "size.h"

#include <algorithm>
#include <numeric>

namespace vcg_ext {

namespace {

/// Per vertex the lowest number of a vertex that it hangs together with.
std::vector<int> lowest_connected(const Surface& surface)
{
    std::vector<int> lowest(surface.points.size());
    std::iota(lowest.begin(), lowest.end(), 0);
    const auto of = [&](int v) {
        while (lowest[v] != v)
            v = lowest[v] = lowest[lowest[v]];
        return v;
    };
    for (const Triangle& t : surface.triangles)
        for (const int k : {1, 2}) {
            const int a = of(t[0]);
            const int b = of(t[k]);
            lowest[std::max(a, b)] = std::min(a, b);
        }
    for (std::size_t v = 0; v < lowest.size(); ++v)
        lowest[v] = of(static_cast<int>(v));
    return lowest;
}

} // namespace

std::vector<Part> connected_parts(const Surface& surface, int most, double least_share)
{
    const std::vector<int> lowest = lowest_connected(surface);
    const std::vector<double> areas = doubled_areas(surface.points, surface.triangles);
    std::vector<double> area(surface.points.size(), 0);
    double whole = 0;
    for (std::size_t f = 0; f < areas.size(); ++f) {
        area[lowest[surface.triangles[f][0]]] += areas[f];
        whole += areas[f];
    }
    std::vector<int> order;
    for (std::size_t v = 0; v < area.size(); ++v)
        if (area[v] > 0 && area[v] >= least_share * whole)
            order.push_back(static_cast<int>(v));
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return area[a] > area[b]; });
    if (static_cast<int>(order.size()) > most)
        order.resize(most);

    std::vector<Part> parts(order.size());
    std::vector<int> part_of(surface.points.size(), -1);
    for (std::size_t i = 0; i < order.size(); ++i) {
        part_of[order[i]] = static_cast<int>(i);
        parts[i].area_share = area[order[i]] / whole;
    }
    std::vector<int> number(surface.points.size(), -1);
    for (std::size_t v = 0; v < surface.points.size(); ++v)
        if (const int part = part_of[lowest[v]]; part >= 0) {
            number[v] = static_cast<int>(parts[part].surface.points.size());
            parts[part].surface.points.push_back(surface.points[v]);
        }
    for (const Triangle& t : surface.triangles)
        if (const int part = part_of[lowest[t[0]]]; part >= 0)
            parts[part].surface.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
    return parts;
}

} // namespace vcg_ext
