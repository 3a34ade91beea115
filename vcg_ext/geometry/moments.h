// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

#include <array>
#include <string>

namespace vcg_ext {

/// The coordinate system that a body itself defines, whatever its position, rotation and scale.
///
/// A body with equal variances or without third moments has no unique frame: `variances` and `third_moments` show that.
struct Frame {
    Point centre = Point::Zero();
    /// Columns: the unit principal axes by descending variance; right-handed. The third moments along the first two are
    /// not negative. Coordinates of `p` in the frame: `axes.transpose() * (p - centre)`.
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    Point variances = Point::Zero();     ///< mean of x^2, y^2, z^2 in the frame; descending
    Point third_moments = Point::Zero(); ///< mean of x^3, y^3, z^3 in the frame: M300, M030, M003 over the measure
    double measure = 0;                  ///< signed volume (negative: inside out), or the area; 0: there is no frame
    bool from_volume = false;            ///< moments of the enclosed solid; else of the surface itself
};

/// The frame of the solid that the triangles bound ((3.1)-(3.5)): `measure` is the signed volume, by which all moments
/// are divided, so that a body turned inside out has the same frame. It is 0 where the triangles enclose nothing to
/// speak of or their second moments are no solid's.
///
/// \pre the triangles' boundary is empty, or the moments depend on where the origin is
[[nodiscard]] Frame solid_frame(const Points& points, const std::vector<Triangle>& triangles);

/// The frame of the surface itself, weighted by area. `measure` is 0 where no face has one.
[[nodiscard]] Frame area_frame(const Points& points, const std::vector<Triangle>& triangles);

/// Whether the body is so even along an axis (0 to 2) that its third moment there may change sign.
[[nodiscard]] bool is_symmetric(const Frame& frame, int axis);

/// Which of the first two principal axes point the other way; the third then does what keeps them right-handed.
struct AxisFlips {
    bool first = false;
    bool second = false;
};

/// All that there are, none flipped first.
constexpr std::array<AxisFlips, 4> axis_flips = {{{false, false}, {true, false}, {false, true}, {true, true}}};

/// Such as "+-".
[[nodiscard]] std::string name(AxisFlips flips);

/// The frame with its axes flipped.
[[nodiscard]] Frame flipped(Frame frame, AxisFlips flips);

/// Whether the body is so even that its frame may as well be the flipped one.
[[nodiscard]] bool may_be_flipped(const Frame& frame, AxisFlips flips);

/// `frame`, its axes pointing the way that those of `like` do.
[[nodiscard]] Frame turned_like(Frame frame, const Frame& like);

/// Whether two variances are so near to each other that the axes may turn, or swap.
[[nodiscard]] bool is_round(const Frame& frame);

/// Sum of the signed tetrahedra over `centre` (3.2); for a closed surface its volume, whatever `centre` is.
[[nodiscard]] double signed_volume(const Surface& surface, const Point& centre = Point::Zero());

} // namespace vcg_ext
