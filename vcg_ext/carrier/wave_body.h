// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../geometry/solid.h"

#include <vector>

namespace vcg_ext {

/// A solid in coordinates of its own: x = axes^T (v - centre) / r, r the radius of the ball of its volume.
///
/// **Axes** are the principal ones. Where two variances are within 5 % of each other, as those of vases, gears and bolts
/// are, they say nothing of the angle about the third axis, the odd one: then the mean of (x + i y)^fold over the solid
/// is real and positive, for the lowest number that gives a clear value.
struct WaveBody {
    SolidTopology topology;
    Points points; ///< sites and apexes, canonical
    Frame frame;
    int fold = 0; ///< 0: all axes are those of the variances
    int odd_axis = 2;
    /// The frames that another copy of the body may have instead: x there = turn * x here. The first is this one; then
    /// half-turns about the axes, or all that `fold` cannot tell apart; near the border, those of the other kind too.
    std::vector<Eigen::Matrix3d> turns;
    double radius = 0;   ///< r, in the mesh's unit
    double area = 0;     ///< of the surface without its fans, over r^2
    double diagonal = 0; ///< of the bounding box, in the mesh's unit
};

/// \pre the surface is mended, see body_of()  \throw Error where it encloses nothing
[[nodiscard]] WaveBody wave_body(const Surface& surface);

/// The frame by the body's rule of other points in its place, the axes nearest to `like`. `measure` 0 or of another
/// sign than the body's where they bound nothing.
[[nodiscard]] Frame frame_again(const WaveBody& body, const Points& points, const Eigen::Matrix3d& like);

/// Points in a frame.
[[nodiscard]] Points canonical(const Frame& frame, const Points& points);

/// Of the surface without its fans, were its points there.
[[nodiscard]] double area_of(const WaveBody& body, const Points& points);

} // namespace vcg_ext
