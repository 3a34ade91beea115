// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts.h"

#include "size.h"

#include <algorithm>

namespace vcg_ext {

Sets pieces_of(const Surface& surface)
{
    Sets sets(static_cast<int>(surface.points.size()));
    for (const auto& [a, b, c] : surface.triangles) {
        sets.join(a, b);
        sets.join(a, c);
    }
    return sets;
}

std::vector<Part> connected_parts(const Surface& surface, int most, double least_share)
{
    Sets pieces = pieces_of(surface);
    const std::vector<double> areas = doubled_areas(surface.points, surface.triangles);
    std::vector<double> area(surface.points.size(), 0);
    double whole = 0;
    for (std::size_t f = 0; f < areas.size(); ++f) {
        area[pieces.of(surface.triangles[f][0])] += areas[f];
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
        if (const int part = part_of[pieces.of(static_cast<int>(v))]; part >= 0) {
            number[v] = static_cast<int>(parts[part].surface.points.size());
            parts[part].surface.points.push_back(surface.points[v]);
        }
    for (const Triangle& t : surface.triangles)
        if (const int part = part_of[pieces.of(t[0])]; part >= 0)
            parts[part].surface.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
    return parts;
}

} // namespace vcg_ext
