// SPDX-License-Identifier: GPL-3.0-or-later
#include "thesis_patches.h"

#include "../base/parallel.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace vcg_ext {

namespace {

/// Area of a triangle's part within the box between `low` and `high` along axes 1 and 2.
double area_within(const Points& points, const Triangle& t, const Point& low, const Point& high)
{
    std::vector<Point> polygon = {points[t[0]], points[t[1]], points[t[2]]};
    for (int axis = 0; axis < 2; ++axis)
        for (const double side : {1.0, -1.0}) {
            const auto depth = [&](const Point& p) { return side > 0 ? p[axis] - low[axis] : high[axis] - p[axis]; };
            std::vector<Point> clipped;
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const Point& a = polygon[i];
                const Point& b = polygon[(i + 1) % polygon.size()];
                if (depth(a) >= 0)
                    clipped.push_back(a);
                if ((depth(a) >= 0) != (depth(b) >= 0))
                    clipped.emplace_back(a + (b - a) * (depth(a) / (depth(a) - depth(b))));
            }
            polygon.swap(clipped);
        }
    Point sum = Point::Zero();
    for (std::size_t i = 2; i < polygon.size(); ++i)
        sum += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
    return sum.norm() / 2;
}

/// Lines 3 to 18 of Algorithm 1 for one layer, whose patches are numbered from `patch` on. Returns the first number
/// that is not used up; its vertices are the layer's leftover.
int grow_patches(const Points& local, const std::vector<Triangle>& triangles, const VertexFaces& around,
                 const std::vector<int>& sorted, const Point& low, const Point& high, double patch_area,
                 std::vector<char>& processed, int patch, std::vector<int>& label)
{
    double area = 0;
    for (const int v : sorted) {
        label[v] = patch;
        for (const int* f = around.begin(v); f != around.end(v); ++f) {
            const Triangle& t = triangles[*f];
            if (processed[*f] || std::any_of(t.begin(), t.end(), [&](int w) { return label[w] < 0; }))
                continue;
            processed[*f] = 1;
            area += area_within(local, t, low, high);
            if (area > patch_area) {
                label[v] = ++patch;
                area -= patch_area;
            }
        }
    }
    return patch;
}

/// Along an axis; equal ones by number, so that no sort decides.
struct By {
    const Points& points;
    int axis;

    bool operator()(int a, int b) const
    {
        return points[a][axis] != points[b][axis] ? points[a][axis] < points[b][axis] : a < b;
    }
};

/// The vertices in [low, high) along axis 1, in this order.
struct Trimmed {
    std::vector<int> vertices;
    double low;
    double high;
};

/// Cuts `trim` of the range off at both ends (3.6).
Trimmed trimmed(const Points& points, double trim)
{
    std::vector<int> inside(points.size());
    std::iota(inside.begin(), inside.end(), 0);
    std::sort(inside.begin(), inside.end(), By{points, 0});
    const double least = points[inside.front()].x();
    const double range = points[inside.back()].x() - least;
    const double low = least + trim * range;
    const double high = least + (1 - trim) * range;
    inside.erase(std::remove_if(inside.begin(), inside.end(),
                                [&](int v) { return points[v].x() < low || points[v].x() >= high; }),
                 inside.end());
    return {std::move(inside), low, high};
}

} // namespace

Patches thesis_patches(const Points& points, const SolidTopology& topology, const Frame& frame, int layers, int count,
                       double trim)
{
    check_frame(frame);
    const Points local = in_frame(points, frame);
    const std::vector<Triangle> triangles(topology.triangles.begin(),
                                          topology.triangles.begin() + topology.surface_triangles);
    const int vertices = static_cast<int>(local.size());
    const auto [inside, low, high] = trimmed(local, trim);
    if (inside.empty())
        return {1, 0, std::vector<int>(vertices, -1)};

    Point from(low, 0, 0);
    Point to(high, 0, 0);
    const auto [lowest, highest] = std::minmax_element(inside.begin(), inside.end(), By{local, 1});
    const double bottom = local[*lowest].y();
    const double height = (local[*highest].y() - bottom) / layers;
    from.y() = bottom;
    to.y() = bottom + layers * height;
    const auto layer_at = [&](double y) {
        return height > 0 ? std::min(layers - 1, static_cast<int>((y - bottom) / height)) : 0;
    };
    const double total = ordered_sum(static_cast<int>(triangles.size()), 0.0,
                                     [&](int f) { return area_within(local, triangles[f], from, to); });

    const VertexFaces around = vertex_faces(vertices, triangles);
    std::vector<char> processed(triangles.size(), 0);
    Patches patches{1, 0, std::vector<int>(vertices, -1)};
    std::vector<int> leftover;
    for (int layer = 0; layer < layers; ++layer) {
        from.y() = bottom + layer * height;
        to.y() = from.y() + height;
        std::vector<int> sorted;
        for (const int v : inside)
            if (layer_at(local[v].y()) == layer)
                sorted.push_back(v);
        patches.columns = grow_patches(local, triangles, around, sorted, from, to, total / count, processed,
                                       patches.columns, patches.label);
        for (const int v : sorted)
            if (patches.label[v] == patches.columns) {
                leftover.push_back(v);
                patches.label[v] = vertices; // any number but -1: its faces count to the next layer (line 9)
            }
    }
    for (const int v : leftover)
        patches.label[v] = -1;
    return patches;
}

} // namespace vcg_ext
