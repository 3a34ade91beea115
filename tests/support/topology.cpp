// SPDX-License-Identifier: GPL-3.0-or-later
#include "topology.h"

#include <algorithm>
#include <map>
#include <set>

using namespace vcg_ext;

bool is_closed_manifold(const Surface& surface)
{
    std::map<std::pair<int, int>, int> face_of_edge; // by direction
    for (std::size_t f = 0; f < surface.triangles.size(); ++f)
        for (int k = 0; k < 3; ++k) {
            const std::pair edge(surface.triangles[f][k], surface.triangles[f][(k + 1) % 3]);
            if (edge.first == edge.second || !face_of_edge.try_emplace(edge, static_cast<int>(f)).second)
                return false;
        }
    std::vector<int> faces_at(surface.points.size(), 0);
    std::vector<int> out_of(surface.points.size(), -1);
    for (const auto& [edge, face] : face_of_edge) {
        if (face_of_edge.count({edge.second, edge.first}) == 0)
            return false;
        ++faces_at[edge.first];
        out_of[edge.first] = edge.second;
    }
    for (std::size_t v = 0; v < surface.points.size(); ++v) {
        int fan = 0;
        int to = out_of[v];
        if (to < 0)
            return false;
        do { // to the third corner of the face that runs v -> to, which another face leaves v for
            const Triangle& t = surface.triangles[face_of_edge.at({static_cast<int>(v), to})];
            to = *std::find_if(t.begin(), t.end(), [&](int x) { return x != static_cast<int>(v) && x != to; });
            ++fan;
        } while (to != out_of[v]);
        if (fan != faces_at[v])
            return false;
    }
    return true;
}

int euler_characteristic(const Surface& surface)
{
    std::set<std::pair<int, int>> edges;
    for (const Triangle& t : surface.triangles)
        for (int k = 0; k < 3; ++k)
            edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
    return static_cast<int>(surface.points.size()) - static_cast<int>(edges.size()) +
           static_cast<int>(surface.triangles.size());
}

Surface soup(const Surface& surface)
{
    Surface result;
    for (const Triangle& t : surface.triangles) {
        const int first = static_cast<int>(result.points.size());
        for (const int v : t)
            result.points.push_back(surface.points[v]);
        result.triangles.push_back({first, first + 1, first + 2});
    }
    return result;
}

Surface joined(Surface first, const Surface& second)
{
    const int offset = static_cast<int>(first.points.size());
    first.points.insert(first.points.end(), second.points.begin(), second.points.end());
    for (const Triangle& t : second.triangles)
        first.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
    return first;
}
