// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../geometry/fast_marching.h"
#include "../geometry/solid.h"
#include "../key/stream.h"
#include "carriers.h"

#include <optional>
#include <string>
#include <vector>

namespace vcg_ext {

/// Where the strips of geodesic distance begin and end (thesis 4.3.1, 4.3.2).
struct StripFrame {
    SurfacePoint source;
    /// T_max; T_min is 0, the source itself. Empty: the farthest distance that the march finds.
    std::optional<double> farthest;
    bool round = false;      ///< whether the body's axes may turn, and the source with them
    std::string orientation; ///< how the body is held, where it is too even along an axis to tell; else empty
};

/// By the body's own frame, and by the flipped ones where it is so even that those may be its own.
using StripFrames = std::vector<StripFrame>;

/// Strips of equal geodesic distance from a point that only the key knows.
struct Strips {
    std::vector<double> distances; ///< per vertex; infinite where no path of faces leads to it
    double farthest = 0;           ///< T_max
    Carriers carriers;
    int smoothing_rounds = 0; ///< of the surface before the march, see read_strips()
    int unreached = 0;        ///< vertices that no path of faces leads to; they carry nothing
};

/// Directions in a body's own frame, the one after the other to be tried as the way to the source.
[[nodiscard]] Points source_directions(Stream draws);

// All that follows walks over a closed surface: solid_points() with the topology's triangles. So the front crosses
// holes, filled or not. `carrying` is the number of its vertices; the apexes after them carry nothing.

/// Finds the source: the farthest point of the surface in a direction of the body's own frame, the next direction where
/// the ray misses (4.3).
///
/// \throw Error where no ray from the centre meets the surface
[[nodiscard]] StripFrame strip_frame(const Surface& closed, const Frame& frame, const Points& directions);

/// The same for each way in which the body may be held, that of `frame` first.
[[nodiscard]] StripFrames strip_frames(const Surface& closed, const Frame& frame, const Points& directions);

/// The strips between `trim` and 1 - `trim` of the farthest distance from the frame's source ((4.4)-(4.6) with their
/// offset put right). \param distances per point of the closed surface, see distances_from()
[[nodiscard]] Strips strips_from(const StripFrame& frame, std::vector<double> distances, int carrying, double trim,
                                 int count);

/// The strips, were there `count` of them.
[[nodiscard]] Carriers recut(const Strips& strips, double trim, int count);

/// The same point of the material in other positions of the surface's vertices.
[[nodiscard]] SurfacePoint carried_along(const SurfacePoint& source, const Surface& surface, const Points& points);

/// The strips as a blind detector sees them.
///
/// Noise roughens the surface, and a rough surface has longer ways. So the march is repeated with 1 and 3 rounds of
/// smoothing along the normals, which keeps the density along the surface that carries the mark. That reading is taken
/// whose statistics lie farthest from their threshold: largest sum of n s^2. It never looks at the mask, so p stays
/// exact.
[[nodiscard]] Strips read_strips(const Surface& closed, const Fans& fans, int carrying, const StripFrame& frame,
                                 double trim, int count, Statistic statistic);

} // namespace vcg_ext
