// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

#include <array>

namespace vcg_ext {

/// Integrals of the monomials up to the third degree over a solid.
struct SolidMoments {
    double volume = 0; ///< signed, as all of them: positive where the triangles run counterclockwise seen from outside
    Point first = Point::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    std::array<Eigen::Matrix3d, 3> third{Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()};
};

/// The moments of what the triangles enclose, about `origin`: sums over the tetrahedra from there to each of them.
/// About a point far from the solid they cancel badly.
[[nodiscard]] SolidMoments solid_moments(const Points& points, const std::vector<Triangle>& triangles,
                                         const Point& origin);

} // namespace vcg_ext
