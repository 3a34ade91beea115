// SPDX-License-Identifier: GPL-3.0-or-later
#include "feet.h"

#include "../base/parallel.h"
#include "normals.h"

#include <algorithm>

namespace vcg_ext {

namespace {

constexpr double border = 1e-9; ///< weight of a corner below which a place lies on the edge opposite to it

/// Weights of the corners at which a point of the face lies; along its longest edge where it has no width.
Point weights_of(const Point& p, const Point& a, const Point& b, const Point& c)
{
    const Point u = b - a;
    const Point v = c - a;
    const Point n = u.cross(v);
    const double area = n.squaredNorm();
    const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (c - b).squaredNorm()});
    Point weights;
    if (area > 1e-24 * longest * longest) {
        weights[1] = n.dot((p - a).cross(v)) / area;
        weights[2] = n.dot(u.cross(p - a)) / area;
        weights[0] = 1 - weights[1] - weights[2];
    } else {
        const std::array<const Point*, 3> corner = {&a, &b, &c};
        weights.setZero();
        for (int k = 0; k < 3; ++k) {
            const Point& from = *corner[k];
            const Point edge = *corner[(k + 1) % 3] - from;
            if (edge.squaredNorm() < longest || longest == 0)
                continue;
            const double t = (p - from).dot(edge) / longest;
            weights.setZero();
            weights[k] = 1 - t;
            weights[(k + 1) % 3] = t;
        }
        if (longest == 0)
            weights[0] = 1;
    }
    weights = weights.cwiseMax(0);
    return weights / weights.sum();
}

} // namespace

FootSearch::FootSearch(Surface surface)
    : surface_(std::move(surface)), normals_(face_normals(surface_.points, surface_.triangles)),
      open_(surface_.triangles.size(), 0), rim_(surface_.points.size(), 0), nearest_(surface_)
{
    const VertexFaces around = vertex_faces(static_cast<int>(surface_.points.size()), surface_.triangles);
    for_each_index(static_cast<int>(surface_.triangles.size()), [&](int f) {
        const Triangle& t = surface_.triangles[f];
        for (int k = 0; k < 3; ++k) {
            const int from = t[(k + 1) % 3];
            const int to = t[(k + 2) % 3];
            const bool shared = std::any_of(around.begin(from), around.end(from), [&](int other) {
                const Triangle& o = surface_.triangles[other];
                return other != f && (o[0] == to || o[1] == to || o[2] == to);
            });
            if (!shared)
                open_[f] = static_cast<unsigned char>(open_[f] | (1 << k));
        }
    });
    for (std::size_t f = 0; f < open_.size(); ++f)
        for (int k = 0; k < 3; ++k)
            if (open_[f] & (1 << k))
                for (const int j : {1, 2})
                    rim_[surface_.triangles[f][(k + j) % 3]] = 1;
}

Foot FootSearch::operator()(const Point& p, double reach) const
{
    const ClosestPoint found = nearest_(p, reach);
    Foot foot;
    if (found.face < 0)
        return foot;
    foot.face = found.face;
    foot.point = found.point;
    foot.distance = found.distance;
    const Triangle& t = surface_.triangles[found.face];
    foot.weights = weights_of(found.point, surface_.points[t[0]], surface_.points[t[1]], surface_.points[t[2]]);
    for (int k = 0; k < 3; ++k) {
        const bool on_edge = foot.weights[k] < border && (open_[found.face] & (1 << k)) != 0;
        const bool at_corner = foot.weights[k] > 1 - border && rim_[t[k]] != 0;
        foot.on_rim = foot.on_rim || on_edge || at_corner;
    }
    return foot;
}

} // namespace vcg_ext
