// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/parallel.h"
#include "../base/prefetch.h"
#include "../base/surface.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace vcg_ext {

/// The unmarked surface with what placements ask of it, computed once.
struct Cover {
    /// \param unmarked must outlive the cover
    explicit Cover(const Surface& unmarked, std::vector<char> fixed = {})
        : Cover(
              unmarked, std::move(fixed),
              std::make_shared<VertexFaces>(vertex_faces(static_cast<int>(unmarked.points.size()), unmarked.triangles)))
    {
    }

    /// \param faces around its vertices
    Cover(const Surface& unmarked, std::vector<char> fixed, std::shared_ptr<const VertexFaces> faces)
        : surface(unmarked), points(surface.points), triangles(surface.triangles), held(std::move(fixed)),
          shared(std::move(faces)), around(*shared), normals(triangles.size()), areas(triangles.size())
    {
        for_each_index(static_cast<int>(triangles.size()), [this](int f) {
            prefetch_corners(points, triangles, f);
            normals[f] = scaled_normal(points, triangles[f]);
            areas[f] = normals[f].norm();
            normals[f] = areas[f] > 0 ? Point(normals[f] / areas[f]) : Point(Point::Zero());
        });
    }

    const Surface& surface;
    const Points& points;
    const std::vector<Triangle>& triangles;
    std::vector<char> held; ///< per vertex whether it must not slide; those beyond the last may
    std::shared_ptr<const VertexFaces> shared;
    const VertexFaces& around; ///< the shared ones
    Points normals;            ///< of faces, unit; zero where a face has no area
    std::vector<double> areas; ///< of faces, doubled

    [[nodiscard]] bool holds(int v) const { return v < static_cast<int>(held.size()) && held[v]; }
};

/// Whether a face no longer lies as on the cover: turned by more than 60 degrees, or down to a twentieth of its area.
///
/// 60 and not 90: the promise is 90, and rounding to float must not break it.
[[nodiscard]] inline bool folded(const Cover& cover, int face, const Point& scaled_normal_now)
{
    const Point& n = cover.normals[face];
    if (n.isZero())
        return false; // without an area there is no side to turn away from
    return n.dot(scaled_normal_now) < std::max(0.5 * scaled_normal_now.norm(), cover.areas[face] / 20);
}

/// Whether a face around vertex `v` is folded where that is at `position` and its neighbours are where
/// `current` has them.
[[nodiscard]] inline bool folds_around(const Cover& cover, const Points& current, int v, const Point& position)
{
    return std::any_of(cover.around.begin(v), cover.around.end(v), [&](int f) {
        return folded(cover, f, scaled_normal_with(current, cover.triangles[f], v, position));
    });
}

} // namespace vcg_ext
