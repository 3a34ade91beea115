// SPDX-License-Identifier: GPL-3.0-or-later
#include "sqrt3.h"

#include "../base/pi.h"
#include "../base/progress.h"
#include "../geometry/edge_graph.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace vcg_ext {

namespace {

/// A face's side, by its vertices in ascending order.
struct Side {
    int low = 0;
    int high = 0;
    int face = 0;
    int corner = 0; ///< where it begins

    [[nodiscard]] bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

/// By edge; those of one edge in the order of faces.
std::vector<Side> sides_of(const std::vector<Triangle>& triangles)
{
    std::vector<Side> sides;
    for (std::size_t f = 0; f < triangles.size(); ++f)
        for (int k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(triangles[f][k], triangles[f][(k + 1) % 3]);
            sides.push_back({low, high, static_cast<int>(f), k});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tie(a.low, a.high, a.face, a.corner) < std::tie(b.low, b.high, b.face, b.corner);
    });
    return sides;
}

/// The old vertices, each inside the surface moved towards the mean of its neighbours.
Points relaxed(const Surface& surface, const std::vector<char>& inside)
{
    const EdgeGraph graph = edge_graph(surface);
    Points result = surface.points;
    for (int v = 0; v < graph.vertices(); ++v) {
        const int n = graph.degree(v);
        if (!inside[v] || n == 0)
            continue;
        Point mean = Point::Zero();
        for (const int* other = graph.begin(v); other != graph.end(v); ++other)
            mean += surface.points[*other] / n;
        const double part = (4 - 2 * std::cos(2 * pi / n)) / 9;
        result[v] = (1 - part) * surface.points[v] + part * mean;
    }
    return result;
}

Surface subdivided(const Surface& surface)
{
    const std::vector<Triangle>& old = surface.triangles;
    const int vertices = static_cast<int>(surface.points.size());
    std::vector<char> inside(surface.points.size(), 1);
    std::vector<Triangle> triangles;
    const auto middle = [&](const Side& side) { return vertices + side.face; };
    const std::vector<Side> sides = sides_of(old);
    for (std::size_t first = 0; first < sides.size();) {
        std::size_t last = first + 1;
        while (last < sides.size() && sides[last].same_edge(sides[first]))
            ++last;
        const Side& side = sides[first];
        const int from = old[side.face][side.corner];
        const int to = old[side.face][(side.corner + 1) % 3];
        if (last - first == 2 && old[sides[first + 1].face][sides[first + 1].corner] == to) {
            triangles.push_back({from, middle(sides[first + 1]), middle(side)});
            triangles.push_back({to, middle(side), middle(sides[first + 1])});
        } else
            for (std::size_t i = first; i < last; ++i) {
                const Triangle& face = old[sides[i].face];
                triangles.push_back({face[sides[i].corner], face[(sides[i].corner + 1) % 3], middle(sides[i])});
                inside[side.low] = inside[side.high] = 0;
            }
        first = last;
    }
    Points points = relaxed(surface, inside);
    for (const Triangle& t : old)
        points.emplace_back((surface.points[t[0]] + surface.points[t[1]] + surface.points[t[2]]) / 3);
    return {std::move(points), std::move(triangles)};
}

} // namespace

Surface subdivide_by_sqrt3(const Surface& surface, int iterations, const Progress& progress)
{
    Surface result = surface;
    for (int i = 0; i < iterations; ++i) {
        report(progress, 100 * i / iterations, "Subdividing");
        result = subdivided(result);
    }
    return result;
}

} // namespace vcg_ext
