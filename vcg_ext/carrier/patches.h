// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../geometry/laplacian.h"
#include "../geometry/moments.h"
#include "../geometry/solid.h"

namespace vcg_ext {

/// A grid of patches over a surface: layers across the second principal axis, columns along the first.
struct Patches {
    int layers = 0;
    int columns = 0;
    std::vector<int> label; ///< per vertex its patch, layer * columns + column; -1 outside

    [[nodiscard]] int count() const { return layers * columns; }

    /// The patch at the place of `patch` where the axes point the other way. Its own inverse.
    [[nodiscard]] int flipped(int patch, AxisFlips flips) const;
};

/// How many patches there are for `bits` bits: a tenth more, at least six, rounded up to full layers (64: 70). The
/// spare ones carry what tells a body's ends apart, see blind_orientation().
[[nodiscard]] int patch_count(int bits, int layers);

/// Cuts a surface into layers * columns patches of equal area (thesis 3.3).
///
/// All cuts are quantiles of area, of a copy that Taubin passes have smoothed: neither noise, which swells the area of
/// fine regions, nor a single vertex at the end of an axis moves them. Holes count with the area of their fans. First
/// `trim` of the area is left out at both ends of axis 1; then come layers of equal area along axis 2, then in each layer
/// columns of equal area along axis 1.
/// \param trim in [0, 0.5)
/// \throw Error where the surface has no area, and so no frame
[[nodiscard]] Patches equal_area_patches(const Points& vertices, const SolidTopology& topology, const EdgeGraph& graph,
                                         const Frame& frame, int layers, int columns, double trim);

/// \throw Error where the surface had no area, and so has no frame
void check_frame(const Frame& frame);

/// Points along a frame's axes, about its centre.
[[nodiscard]] Points in_frame(Points points, const Frame& frame);

/// Per patch its vertices, ascending.
[[nodiscard]] std::vector<std::vector<int>> patch_vertices(const Patches& patches);

} // namespace vcg_ext
