// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cover.h"
#include "moves.h"

#include <functional>

namespace vcg_ext {

/// Takes moves back, step by step, until no face is folded.
///
/// A vertex is at step 0 where it was placed. All vertices of a folded face go one step further together, again and
/// again till the face lies right. Steps only grow, and at the last the vertex is back on the cover, where no face is
/// folded: so this ends, and the order of vertices or threads has no part in the result.
///
/// \param placed  positions at step 0; on return the guarded ones
/// \param retreat the position of a vertex at step 1 to `steps` - 1, by these and its own place in `placed` alone; at
///                `steps` it is the cover's own. Several threads call it, for different vertices
/// \param bad     the faces that are folded at step 0
/// \return the vertices that went back, and where they were placed
Moves guard_folds(const Cover& cover, Points& placed, std::vector<int> bad, int steps,
                  const std::function<Point(int vertex, int step)>& retreat);

/// The same, which looks for those faces itself.
Moves guard_folds(const Cover& cover, Points& placed, int steps,
                  const std::function<Point(int vertex, int step)>& retreat);

/// Faces of `points` that are folded against the cover, in ascending order.
[[nodiscard]] std::vector<int> folded_faces(const Cover& cover, const Points& points);

/// The same, in any order, where only the vertices `moved` are elsewhere than when it was `before`.
[[nodiscard]] std::vector<int> folded_faces(const Cover& cover, const Points& points, const std::vector<int>& before,
                                            const std::vector<int>& moved);

} // namespace vcg_ext
