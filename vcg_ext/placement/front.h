#pragma once
#include "../geometry/fast_marching.h"
#include "cover.h"

#include <array>

namespace vcg_ext {

enum class FrontScheme {
    /// All vertices at once along the direction that costs least distance from the surface; then the rest in the order of
    /// the front.
    PredictCorrect,
    /// The thesis' vertex placement scheme: one vertex after the other along the front's gradient (theorem 1), without its
    /// limit (4.21), which as printed or put right leaves more vertices short of their targets than it saves.
    Sequential
};

struct FrontOptions {
    FrontScheme scheme = FrontScheme::PredictCorrect;
    MarchOptions march;
};

/// How many vertices took how many moves (the thesis' Table 4.5).
struct MoveCounts {
    std::array<int, 4> moves{}; ///< 1, 2, 3, and 4 or more
    int unconverged = 0;        ///< ended short of their targets, at the nearest point that folds no face

    [[nodiscard]] int total() const { return moves[0] + moves[1] + moves[2] + moves[3] + unconverged; }
};

struct FrontPlacement {
    Points points;
    MoveCounts counts;
};

/// Moves vertices, mostly along the surface, until the front of a march reaches each at its target (thesis 4.3.4).
///
/// No face turns by more than 60 degrees (folded()).
///
/// \param arrivals  march() on the cover
/// \param targets   one a vertex; NaN: it must not move
/// \param tolerance of the distances
[[nodiscard]] FrontPlacement place_front(const Cover& cover, const std::vector<Arrival>& arrivals,
                                         const std::vector<double>& targets, double tolerance,
                                         const FrontOptions& options = {});

} // namespace vcg_ext
