#pragma once
#include "../geometry/fast_marching.h"
#include "../watermark.h"
#include "cover.h"

namespace vcg_ext {

struct FrontOptions {
    FrontScheme scheme = FrontScheme::PredictCorrect;
    MarchOptions march;
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
