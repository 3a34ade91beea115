// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

namespace shapes {

using namespace vcg_ext;

Surface box(double a, double b, double c)
{
    Surface s;
    for (int i = 0; i < 8; ++i)
        s.points.emplace_back((i & 1) ? a : 0, (i & 2) ? b : 0, (i & 4) ? c : 0);
    s.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return s;
}

Surface sphere(int levels)
{
    const double g = (1 + std::sqrt(5.0)) / 2;
    Surface s{{{-1, g, 0},
               {1, g, 0},
               {-1, -g, 0},
               {1, -g, 0},
               {0, -1, g},
               {0, 1, g},
               {0, -1, -g},
               {0, 1, -g},
               {g, 0, -1},
               {g, 0, 1},
               {-g, 0, -1},
               {-g, 0, 1}},
              {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
               {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
               {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<int, int>, int> middle;
        const auto between = [&](int a, int b) {
            const auto [at, fresh] = middle.try_emplace(std::minmax(a, b), static_cast<int>(s.points.size()));
            if (fresh)
                s.points.push_back(s.points[a] + s.points[b]);
            return at->second;
        };
        std::vector<Triangle> finer;
        for (const auto& [a, b, c] : s.triangles) {
            const int ab = between(a, b);
            const int bc = between(b, c);
            const int ca = between(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        s.triangles = std::move(finer);
        for (Point& p : s.points)
            p.normalize();
    }
    return s;
}

Surface triangular_grid(double width, double height, double edge)
{
    Surface s;
    const double rise = edge * std::sqrt(0.75);
    const int columns = static_cast<int>(width / edge) + 1;
    const int rows = static_cast<int>(height / rise) + 1;
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c)
            s.points.emplace_back(edge * (c + 0.5 * (r % 2)), rise * r, 0);
    for (int r = 0; r + 1 < rows; ++r)
        for (int c = 0; c + 1 < columns; ++c) {
            const int at = r * columns + c;
            const int up = at + columns;
            if (r % 2 == 0)
                s.triangles.insert(s.triangles.end(), {{at, at + 1, up}, {at + 1, up + 1, up}});
            else
                s.triangles.insert(s.triangles.end(), {{at, at + 1, up + 1}, {at, up + 1, up}});
        }
    return s;
}

Surface moved(Surface surface, double scale, double angle, const Point& axis, const Point& shift)
{
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, axis.normalized()).matrix();
    for (Point& p : surface.points)
        p = scale * rotation * p + shift;
    return surface;
}

Surface renumbered(const Surface& surface, unsigned seed)
{
    std::mt19937 draws(seed);
    std::vector<int> number(surface.points.size());
    std::iota(number.begin(), number.end(), 0);
    std::shuffle(number.begin(), number.end(), draws);
    Surface result = surface;
    for (std::size_t v = 0; v < number.size(); ++v)
        result.points[number[v]] = surface.points[v];
    for (Triangle& t : result.triangles) {
        const Triangle old = t;
        const unsigned turn = draws() % 3;
        for (unsigned k = 0; k < 3; ++k)
            t[k] = number[old[(k + turn) % 3]];
    }
    std::shuffle(result.triangles.begin(), result.triangles.end(), draws);
    return result;
}

} // namespace shapes
