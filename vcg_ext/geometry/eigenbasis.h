// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "laplacian.h"

namespace vcg_ext {

/// The high band of a patch in the exact eigenbasis of its own Laplacian ((3.12)-(3.15)): Q Q^T x, with Q the
/// eigenvectors of the highest `share` of the eigenvalues. Edges that leave the patch do not count.
///
/// A dense solver: time grows with the cube of the vertices.
/// \throw Error where there are more than 2,500
/// \param x the whole mesh's, one row per vertex
/// \return one row per vertex of `vertices`
[[nodiscard]] Points exact_high_band(const EdgeGraph& graph, const Points& x, const std::vector<int>& vertices,
                                     double share);

} // namespace vcg_ext
