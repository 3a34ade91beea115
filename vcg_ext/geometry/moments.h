// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// The coordinate system that a body itself defines, whatever its position, rotation and scale.
struct Frame {
    Point centre = Point::Zero();
    /// Columns: the unit principal axes by descending variance; right-handed. The third moments along the first two are
    /// not negative. Coordinates of `p` in the frame: `axes.transpose() * (p - centre)`.
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    Point variances = Point::Zero();     ///< mean of x^2, y^2, z^2 in the frame; descending
    Point third_moments = Point::Zero(); ///< mean of x^3, y^3, z^3 in the frame: M300, M030, M003 over the measure
    double measure = 0;                  ///< signed volume (negative: inside out), or the area
    bool from_volume = false;            ///< moments of the enclosed solid; else of the surface itself
};

/// Whether the body is so even along an axis (0 to 2) that its third moment there may change sign.
[[nodiscard]] bool is_symmetric(const Frame& frame, int axis);

/// Whether two variances are so near to each other that the axes may turn, or swap.
[[nodiscard]] bool is_round(const Frame& frame);

/// Whether the faces bound a solid: each edge is used as often in one direction as in the other.
[[nodiscard]] bool is_closed_and_oriented(const Surface& surface);

/// Sum of the signed tetrahedra over `centre` (3.2); for a closed surface its volume, whatever `centre` is.
[[nodiscard]] double signed_volume(const Surface& surface, const Point& centre = Point::Zero());

/// Aligns a body by its moments: centre, principal axes, and the axes' signs by the third moments ((3.1)-(3.5)).
///
/// Where the surface is closed and oriented, these are the moments of the solid. Each is divided by the signed volume,
/// so that a body turned inside out has the same frame. For any other surface, and for one that encloses nothing, they
/// are those of the surface, weighted by area.
///
/// A body with equal variances or without third moments has no unique frame: `variances` and `third_moments` show that.
///
/// \pre the surface has a face with an area
[[nodiscard]] Frame principal_frame(const Surface& surface);

} // namespace vcg_ext
