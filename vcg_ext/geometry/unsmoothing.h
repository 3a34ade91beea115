// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "edge_graph.h"
#include "feet.h"

namespace vcg_ext {

/// A surface explained as points of its original that were smoothed over the surface's own edges, as a remeshed or
/// simplified copy is that was smoothed afterwards.
struct Unsmoothed {
    int rounds = 0;         ///< of smoothing with uniform weights, by a half
    double spread = 0;      ///< of what is left unexplained along the normals: 1.48 times the median
    std::vector<Foot> feet; ///< per vertex: where it was on the original
    Points smoothed;        ///< where smoothing takes these places
    Points normals;         ///< of the surface there, unit
    Points laid;            ///< the surface, its place and stretch refitted
};

/// Finds points x of the original with S^rounds x = surface, S a round over the surface's edges, by projections: x is
/// brought to P(z + surface - S^rounds z), P the closest point of the original and z ahead of x by Nesterov's momentum;
/// from the third step on the surface is refitted with twelve unknowns.
///
/// \param laid  on the original  \param size of the original, in whose parts feet are looked for
[[nodiscard]] Unsmoothed unsmooth(const FootSearch& original, double size, const Surface& laid, const EdgeGraph& graph,
                                  int rounds, int steps);

/// The three numbers of rounds that explain the surface best, the best first, from `start` on by halved steps: few
/// steps to compare, more for those three. They go by shape alone. Fewer where so few were tried.
[[nodiscard]] std::vector<Unsmoothed> unsmoothings(const FootSearch& original, double size, const Surface& laid,
                                                   const EdgeGraph& graph, int start);

} // namespace vcg_ext
