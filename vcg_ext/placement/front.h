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

/// How freely each vertex follows the front, in (0, 1]: 1 where it can do so without leaving the surface, as on a plane
/// or along an edge, and near 0 where it must leave it, as across an edge.
[[nodiscard]] std::vector<double> front_mobility(const Cover& cover, const std::vector<Arrival>& arrivals);

/// Moves vertices, mostly along the surface, until the front of a march reaches each at its target (thesis 4.3.4).
///
/// No face turns by more than 60 degrees (folded()).
///
/// \param arrivals  march() on the cover
/// \param targets   one a vertex; NaN: it must not move. None for the corners of the source's face, as nothing comes
/// before \param tolerance of the distances
[[nodiscard]] FrontPlacement place_front(const Cover& cover, const std::vector<Arrival>& arrivals,
                                         const std::vector<double>& targets, double tolerance,
                                         const FrontOptions& options = {});

} // namespace vcg_ext
