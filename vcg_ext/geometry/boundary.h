// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// An edge between two vertices, and how often faces run along it.
struct EdgeUse {
    int low = 0;
    int high = 0;
    int balance = 0; ///< from `low` to `high` more often than back
    int faces = 0;
};

/// Whether the faces bound a solid: each edge is used as often in one direction as in the other.
///
/// Sums a 64-bit hash of each edge by its direction, so it takes one pass, and says yes wrongly once in 2^64 meshes.
[[nodiscard]] bool is_closed_and_oriented(const Surface& surface);

/// The edges that are used more often in one direction than in the other, by their lower vertex: the chain of the
/// triangles' boundary.
[[nodiscard]] std::vector<EdgeUse> boundary(const Surface& surface);

/// The edges of exactly two faces, by their lower vertex.
[[nodiscard]] std::vector<EdgeUse> paired_edges(const Surface& surface);

} // namespace vcg_ext
