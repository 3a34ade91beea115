// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../geometry/fast_marching.h"
#include "cover.h"

#include <array>

namespace vcg_ext {

/// How the front placement places its vertices.
enum class FrontScheme {
    /// All vertices at once along the direction that costs least distance from the surface; then the rest in the order
    /// of the front.
    PredictCorrect,
    /// The thesis' vertex placement scheme: one vertex after the other along the front's gradient (theorem 1), without
    /// its limit (4.21), which as printed or put right leaves more vertices short of their targets than it saves.
    Sequential
};

/// How many vertices took how many moves to their targets (the thesis' Table 4.5).
struct MoveCounts {
    std::array<int, 4> moves{}; ///< 1, 2, 3, and 4 or more
    int unconverged = 0;        ///< ended short of their targets, at the nearest point that folds no face

    [[nodiscard]] int total() const { return moves[0] + moves[1] + moves[2] + moves[3] + unconverged; }
};

struct FrontOptions {
    FrontScheme scheme = FrontScheme::PredictCorrect;
};

struct FrontPlacement {
    Points points;
    MoveCounts counts;
};

/// How freely each vertex follows the front, in (0, 1]: 1 where it can do so without leaving the surface, as on a plane
/// or along an edge, and near 0 where it must leave it, as across an edge.
[[nodiscard]] std::vector<double> front_mobility(const Cover& cover, const std::vector<Arrival>& arrivals);

/// Moves vertices, mostly along the surface, until the front of a march reaches each at its target (thesis 4.3.4).
///
/// No face turns by more than 60 degrees (folded()).
///
/// \param arrivals  arrivals_of() the distances on the cover
/// \param targets   one a vertex; NaN: it must not move. None for the corners of the source's face, as nothing comes
///                  before
/// \param tolerance of the distances
[[nodiscard]] FrontPlacement place_front(const Cover& cover, const std::vector<Arrival>& arrivals,
                                         const std::vector<double>& targets, double tolerance,
                                         const FrontOptions& options = {});

} // namespace vcg_ext
