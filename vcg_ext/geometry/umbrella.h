// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "edge_graph.h"

namespace vcg_ext {

/// One step of Laplacian smoothing with uniform weights: every vertex goes the part `part` of the way to the mean of
/// its neighbours, all at once. Vertices without neighbours stay.
///
/// \param part in (0, 1] to smooth, negative to inflate
[[nodiscard]] Points umbrella_step(const EdgeGraph& graph, const Points& points, double part);

/// So many such steps, one after the other.
[[nodiscard]] Points umbrella_steps(const EdgeGraph& graph, Points points, double part, int steps);

/// Low-pass without shrinking (Taubin 1995): in each pass one step of `shrink`, then one of `inflate`.
///
/// \param shrink in (0, 1)
/// \param inflate below -shrink
[[nodiscard]] Points taubin(const EdgeGraph& graph, Points points, int passes, double shrink = 0.5,
                            double inflate = -0.53);

} // namespace vcg_ext
