// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../geometry/solid.h"
#include "carriers.h"

namespace vcg_ext {

/// Where the shells of vertex norms lie: a centre, and the range of distances from it ((5.1)-(5.5)).
struct ShellFrame {
    /// (5.1) with the normaliser put right: sum A(v) v / sum A(v), the fans that close holes included. However a hole is
    /// filled, that hardly moves it: on lion-head, cut off at the neck, by 1.5e-4 of the diagonal, where the centre of
    /// volume moves by 1.1e-3.
    Point centre = Point::Zero();
    double minimum = 0; ///< of the norms |v - centre|
    double maximum = 0;
};

/// |v - centre| of every vertex.
[[nodiscard]] std::vector<double> norms(const Points& points, const Point& centre);

/// The frame that a surface itself defines.
/// \throw Error where no face has an area, or all norms are the same
[[nodiscard]] ShellFrame shell_frame(const Surface& surface);

/// The same of its vertices elsewhere. \param holes hole_fans() of the surface
[[nodiscard]] ShellFrame shell_frame(const Points& points, const std::vector<Triangle>& triangles,
                                     const HoleFans& holes);

/// \param trim part of the range of norms that is cut off at both ends, eps of (5.2)
[[nodiscard]] Carriers shells(const Points& points, const ShellFrame& frame, double trim, int count);

} // namespace vcg_ext
