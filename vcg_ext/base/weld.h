// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "surface.h"

namespace vcg_ext {

/// A surface in which every position occurs once, and the way back.
///
/// STL files share no vertices and textured meshes repeat them along seams. Vertices at one position count once and
/// move together, so both stay closed, and a mark survives the way from STL to PLY.
struct Welded {
    Surface surface; ///< sites (distinct positions of referenced vertices) and faces with three distinct ones
    std::vector<int> site_of_vertex; ///< per vertex of the original: its site, or -1 where no such face refers to it
};

/// Per point the number of the first that equals it (0 and -0 do): its own where all differ.
///
/// They are dealt to buckets by their hashes, each looked through by itself: all cores have work, and tables fit caches.
[[nodiscard]] std::vector<int> first_equals(const Points& points);

/// Whether each number is that of its place.
[[nodiscard]] bool is_identity(const std::vector<int>& numbers);

/// Welds by exact position (0 and -0 are one). Sites keep the order of their first vertices.
[[nodiscard]] Welded weld(Surface surface);

/// Positions of `original` with those of `sites` put in; vertices without a site keep theirs.
[[nodiscard]] Points unweld(const Points& original, const std::vector<int>& site_of_vertex, const Points& sites);

} // namespace vcg_ext
