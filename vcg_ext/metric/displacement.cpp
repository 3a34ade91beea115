// SPDX-License-Identifier: GPL-3.0-or-later
#include "displacement.h"

#include "../base/parallel.h"
#include "../geometry/nearest.h"

#include <algorithm>
#include <cmath>

namespace vcg_ext {

namespace {

struct Sum {
    double squares = 0;
    double area = 0;
    Sum& operator+=(const Sum& other)
    {
        squares += other.squares;
        area += other.area;
        return *this;
    }
};

/// Three points of equal weight integrate a quadratic over a triangle exactly, and the squared distance to a
/// plane is one.
const std::array<Point, 3> quadrature = {Point(4, 1, 1) / 6, Point(1, 4, 1) / 6, Point(1, 1, 4) / 6};

double distance(const Point& p, const Points& points, const Triangle& t)
{
    return nearest_to_origin(points[t[0]] - p, points[t[1]] - p, points[t[2]] - p).norm();
}

/// Lowers each sample's least distance where the face `t` is nearer; mostly its plane or its size says that it is not.
void lower_distances(const std::array<Point, 3>& samples, const Points& points, const Triangle& t,
                     std::array<double, 3>& least)
{
    const Point normal = scaled_normal(points, t);
    const Point centre = (points[t[0]] + points[t[1]] + points[t[2]]) / 3;
    double squared_radius = 0;
    for (const int v : t)
        squared_radius = std::max(squared_radius, (points[v] - centre).squaredNorm());
    const double radius = std::sqrt(squared_radius);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Point from_centre = samples[i] - centre;
        const double above = from_centre.dot(normal);
        const double reach = least[i] + radius;
        if (above * above < least[i] * least[i] * normal.squaredNorm() && from_centre.squaredNorm() < reach * reach)
            least[i] = std::min(least[i], distance(samples[i], points, t));
    }
}

/// Distances to a face and to those that share a corner with it. The sample's own is nearly always the nearest.
std::array<double, 3> distances(const std::array<Point, 3>& samples, const Points& points,
                                const std::vector<Triangle>& triangles, const VertexFaces& around, int own)
{
    const Triangle& t = triangles[own];
    std::array<double, 3> least;
    for (std::size_t i = 0; i < samples.size(); ++i)
        least[i] = distance(samples[i], points, t);
    for (int k = 0; k < 3; ++k)
        for (const int* f = around.begin(t[k]); f != around.end(t[k]); ++f) {
            const auto seen = [&](int v) { return std::find(t.begin(), t.begin() + k, v) != t.begin() + k; };
            if (*f != own && std::none_of(triangles[*f].begin(), triangles[*f].end(), seen))
                lower_distances(samples, points, triangles[*f], least);
        }
    return least;
}

double rms_one_way(const Points& from, const Points& to, const std::vector<Triangle>& triangles,
                   const VertexFaces& around)
{
    const int faces = static_cast<int>(triangles.size());
    const int stride = std::max(1, faces / 16384);
    const Sum sum = ordered_sum((faces + stride - 1) / stride, Sum(), [&](int i) {
        const Triangle& t = triangles[i * stride];
        std::array<Point, 3> samples;
        for (std::size_t k = 0; k < samples.size(); ++k)
            samples[k] = quadrature[k][0] * from[t[0]] + quadrature[k][1] * from[t[1]] + quadrature[k][2] * from[t[2]];
        double squares = 0;
        for (const double d : distances(samples, to, triangles, around, i * stride))
            squares += d * d;
        const double area = scaled_normal(from, t).norm();
        return Sum{area * squares / static_cast<double>(samples.size()), area};
    });
    return sum.area > 0 ? std::sqrt(sum.squares / sum.area) : 0;
}

} // namespace

double max_displacement(const Points& before, const Points& after)
{
    return std::sqrt(ordered_maximum(static_cast<int>(before.size()), 0.0,
                                     [&](int v) { return (after[v] - before[v]).squaredNorm(); }));
}

int moved_count(const Points& before, const Points& after)
{
    return ordered_sum(static_cast<int>(before.size()), 0, [&](int v) { return before[v] != after[v]; });
}

double local_mrms(const Points& before, const Points& after, const std::vector<Triangle>& triangles,
                  const VertexFaces& around)
{
    return std::max(rms_one_way(before, after, triangles, around), rms_one_way(after, before, triangles, around));
}

} // namespace vcg_ext
