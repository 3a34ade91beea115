// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <vector>

namespace vcg_ext {

using Point = Eigen::Vector3d;
using Points = std::vector<Point>;
using Triangle = std::array<int, 3>;

/// A triangle surface as plain arrays: what a host hands in and gets back.
///
/// Plain on purpose. The two MeshLab generations carry two versions of vcglib, and one program must not see
/// two definitions of one VCG type. So the hosts' meshes end here, and `vcg_ext` uses one vcglib, the same
/// in both (mesh.h).
struct Surface {
    Points points;                   ///< positions
    std::vector<Triangle> triangles; ///< indices into `points`
};

/// Faces around each vertex: those of vertex `v` are `face[first[v]] .. face[first[v + 1] - 1]`, in ascending order.
struct VertexFaces {
    std::vector<int> first; ///< one more than there are vertices
    std::vector<int> face;  ///< three times as many as there are faces

    [[nodiscard]] const int* begin(int v) const { return face.data() + first[v]; }
    [[nodiscard]] const int* end(int v) const { return face.data() + first[v + 1]; }
    [[nodiscard]] int count(int v) const { return first[v + 1] - first[v]; }
};

[[nodiscard]] VertexFaces vertex_faces(int vertices, const std::vector<Triangle>& triangles);

/// Turns all faces to look the other way.
void turn_round(Surface& surface);

/// Twice the area times the unit normal of a triangle.
[[nodiscard]] inline Point scaled_normal(const Points& points, const Triangle& t)
{
    return (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
}

/// The same, were vertex `v` at `position`.
[[nodiscard]] inline Point scaled_normal_with(const Points& points, const Triangle& t, int v, const Point& position)
{
    const auto at = [&](int k) -> const Point& { return t[k] == v ? position : points[t[k]]; };
    return (at(1) - at(0)).cross(at(2) - at(0));
}

/// The box around points; empty where there are none.
[[nodiscard]] Eigen::AlignedBox3d bounding_box(const Points& points);

/// The same once more; on all cores, since what is new of the memory takes longer than the copying.
[[nodiscard]] Points copy_of(const Points& points);

/// Positions as a file of floats holds them.
[[nodiscard]] Points rounded_to_float(const Points& points);

/// The box around the vertices that faces refer to; empty where there are none.
[[nodiscard]] Eigen::AlignedBox3d bounding_box(const Points& points, const std::vector<Triangle>& triangles);
[[nodiscard]] inline Eigen::AlignedBox3d bounding_box(const Surface& surface)
{
    return bounding_box(surface.points, surface.triangles);
}

/// Length of the bounding box's diagonal over the vertices that faces refer to; 0 where there are none.
[[nodiscard]] double bounding_diagonal(const Surface& surface);

} // namespace vcg_ext
