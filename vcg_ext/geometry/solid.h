// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "moments.h"

namespace vcg_ext {

/// What closes a surface, open or broken as it may be, so that it bounds a solid: a chain of triangles with the surface's
/// boundary.
///
/// The edges that are used more often in one direction than in the other are the surface's boundary. Each connected
/// piece of it is closed by a fan from all its edges to one apex, as often as the edge lacks. A missing triangle is so
/// put back, a doubled one is taken away once, one turned round is put right, all exactly: the fan over a triangle's
/// edges is the triangle. Nothing jumps, since no edge decides between two definitions of the solid.
struct HoleFans {
    std::vector<Triangle> fans;
    int sites = 0; ///< the surface's vertices; points from here on are the fans' apexes
    int apexes = 0;
    std::vector<std::array<int, 3>> rims; ///< edges of the boundary, from, to, and the apex they are closed to
    /// Whether neighbours run round the same way throughout. Where no way to turn them makes them, there is no inside and
    /// are no fans.
    bool orientable = true;

    [[nodiscard]] int points() const { return sites + apexes; }
};

/// \pre the surface is mended, see body_of()
[[nodiscard]] HoleFans hole_fans(const Surface& surface);

/// A surface and what closes it in one list of triangles, whose boundary is empty.
struct SolidTopology : HoleFans {
    std::vector<Triangle> triangles; ///< those of the surface, then those of the fans
    int surface_triangles = 0;       ///< triangles from here on are the fans'
};

/// \pre the surface is mended, see body_of()
[[nodiscard]] SolidTopology solid_topology(const Surface& surface);

/// The points that the triangles refer to: an apex is the mean of its fan's edges by length.
[[nodiscard]] Points solid_points(const HoleFans& holes, const Points& vertices);

/// Puts the apexes where the sites are now. \pre `points` holds sites and apexes
void place_apexes(const HoleFans& holes, Points& points);

/// Aligns a body by its moments: centre, principal axes, and the axes' signs by the third moments ((3.1)-(3.5)).
///
/// These are the moments of the solid that surface and fans bound. Where they bound none to speak of, as a sheet or a
/// twisted band does, they are those of surface and fans, weighted by area. Holes, filled or not, are so the same body.
///
/// \param points solid_points()  \return `measure` is 0 where no face has an area
[[nodiscard]] Frame principal_frame(const Points& points, const SolidTopology& topology);

/// \pre the surface is mended, see body_of()
[[nodiscard]] Frame principal_frame(const Surface& surface);

/// Swaps and turns the frame's axes so that each is the nearest to that of `like`: third moments and variances too.
void align_axes(Frame& frame, const Eigen::Matrix3d& like);

/// Radius of the ball of the frame's volume, in the mesh's unit.
[[nodiscard]] double ball_radius(const Frame& frame);

/// Mean over the solid of (x + i y)^n, x and y coordinates along the frame's axes `first` and `second` over
/// ball_radius(): its argument over n is an angle that turns with the body.
///
/// \param n from 1 to 16
[[nodiscard]] std::array<double, 2> angular_moment(const Points& points, const std::vector<Triangle>& triangles,
                                                   const Frame& frame, int first, int second, int n);

} // namespace vcg_ext
