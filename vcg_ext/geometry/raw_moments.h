// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

#include <array>

namespace vcg_ext {

enum class Of { Solid, Area };

/// Integrals of the monomials up to the third degree over a solid or a surface.
struct RawMoments {
    double measure = 0; ///< the area, or the volume; all moments of a solid have its sign
    Point first = Point::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    std::array<Eigen::Matrix3d, 3> third{Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()};
};

/// The moments about `origin` of the triangles, or of what they enclose: then sums over the tetrahedra from there to
/// each of them, positive where triangles run counterclockwise seen from outside. About a point far away they cancel
/// badly.
///
/// The integral of a product of k linear functions over a simplex of d dimensions is its measure times
/// k! d! / (k + d)! times the polarised complete homogeneous polynomial h_k of the functions' values at the corners, of
/// a tetrahedron (d = 3, the values at the origin are zero) or a triangle (d = 2).
[[nodiscard]] RawMoments raw_moments(Of of, const Points& points, const std::vector<Triangle>& triangles,
                                     const Point& origin);

} // namespace vcg_ext
