// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../carrier/patches.h"
#include "../geometry/chebyshev.h"
#include "../placement/moves.h"
#include "../placement/patch_shape.h"
#include "plan.h"

namespace vcg_ext {

constexpr int patch_layers = 2;        ///< the thesis' kappa
constexpr int vertices_of_a_shape = 8; ///< at least

/// What the detector sees of a surface's patches.
struct PatchReading {
    Frame frame;
    Patches patches;
    std::vector<std::vector<int>> vertices; ///< per patch
    Points band;                            ///< per vertex its high band
    std::vector<PatchShape> shapes;         ///< per patch
    double threshold = 0;                   ///< of the logarithm of the ratio

    /// How far the patch's log ratio is above the threshold in standard errors (2 / sqrt(n), as for Gaussian
    /// coefficients).
    [[nodiscard]] double soft(int patch) const;
};

[[nodiscard]] PatchReading read_patches(const Surface& surface, const Plan& plan, const Frame& frame);

/// The patches alone, not what is in them.
[[nodiscard]] PatchReading cut_patches(const Points& points, const SolidTopology& topology, const EdgeGraph& graph,
                                       const Plan& plan, const Frame& frame);

/// What is in the patches that are cut.
void read_bands(Points points, const EdgeGraph& graph, const Plan& plan, PatchReading& reading);

/// Takes up what moves do to the bands, as float stores them; the cuts stay. \param filter patch_filter(graph)
void read_moves(const HighPass& filter, const EdgeGraph& graph, const Moves& moves, const Points& points,
                PatchReading& reading);

/// The reading where the patches are given: `patches.label`, `frame` and the copy's own edges. Poor ones have no part in
/// the threshold.
void read_given(Points points, const EdgeGraph& graph, PatchReading& reading);

/// What leaves a mesh its high band.
[[nodiscard]] HighPass patch_filter(const EdgeGraph& graph);

/// \throw Error where no face has an area
[[nodiscard]] Frame patch_frame(const Points& vertices, const SolidTopology& topology);

/// The patch that carries coded bit i where the axes point as `flips` says, then the spare ones; -1 where the surface
/// has no such.
[[nodiscard]] std::vector<int> carrying_patches(const PatchReading& reading, const Plan& plan, AxisFlips flips);

/// What spare patches carry, by their number: 0, 1, 0, 1, ...
[[nodiscard]] inline bool spare_bit(int number)
{
    return number % 2 == 1;
}

} // namespace vcg_ext
