// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cover.h"

namespace vcg_ext {

/// The point of (5.21) on the sphere of radius `norm` about `centre` that one face offers to its corner `v`: on the way
/// to the face's nearest or farthest point from the centre where the norm lies between, else beyond that point.
[[nodiscard]] Point selective_candidate(const Point& v, const std::array<Point, 3>& face, const Point& centre,
                                        double norm);

/// Quadric selective placement (5.17)-(5.22): of the candidates that the faces around `v` offer, the one with the least
/// quadric error (vcglib's Quadric) that folds none of them; Cho's point where all fold.
[[nodiscard]] Point place_selective(const Cover& cover, int v, const Point& centre, double norm);

} // namespace vcg_ext
