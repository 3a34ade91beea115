// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "moments.h"

namespace vcg_ext {

/// How a surface bounds a solid, open or broken as it may be: a chain of triangles whose boundary is empty.
///
/// The edges that are used more often in one direction than in the other are the surface's boundary. Each connected
/// piece of it is closed by a fan from all its edges to one apex, as often as the edge lacks. A missing triangle is so
/// put back, a doubled one is taken away once, one turned round is put right, all exactly: the fan over a triangle's
/// edges is the triangle. Nothing jumps, since no edge decides between two definitions of the solid.
struct SolidTopology {
    std::vector<Triangle> triangles; ///< those of the surface, over sites, then those of the fans
    std::vector<int> site_of_vertex; ///< vertices of the boundary that lie together are one site; empty: all apart
    int sites = 0;                   ///< points from here on are the fans' apexes
    int apexes = 0;
    int surface_triangles = 0;            ///< triangles from here on are the fans'
    std::vector<std::array<int, 3>> rims; ///< edges of the boundary, from, to, and the apex they are closed to

    [[nodiscard]] int points() const { return sites + apexes; }
};

/// Vertices of the boundary within 1e-5 of the diagonal of each other (less where the boundary's edges are short) are
/// sewn; where neighbours run round in opposite ways, the way of the greater area is taken throughout their component.
///
/// \pre the surface is welded
[[nodiscard]] SolidTopology solid_topology(const Surface& surface);

/// The points that the topology's triangles refer to: a site is the mean of its vertices, an apex the mean of its
/// fan's edges by length.
[[nodiscard]] Points solid_points(const SolidTopology& topology, const Points& vertices);

/// The surface without fans, as sewn and oriented, over its sites.
[[nodiscard]] Surface sewn_surface(const SolidTopology& topology, const Points& vertices);

/// Puts the apexes where the sites are now. \pre `points` holds sites and apexes
void place_apexes(const SolidTopology& topology, Points& points);

/// The principal frame of the solid: see Frame. `measure` is the signed volume, and 0 where the triangles enclose
/// nothing to speak of or their second moments are no solid's.
[[nodiscard]] Frame solid_frame(const Points& points, const std::vector<Triangle>& triangles);

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
