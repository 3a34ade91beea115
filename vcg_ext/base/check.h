// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "weld.h"

namespace vcg_ext {

/// Moments go with the sixth power of the size, quadrics' determinants with the twelfth of it over its square.
constexpr double largest_coordinate = 1e35;

/// \param which what the text calls the mesh
/// \throw Error where a coordinate is not finite, the mesh has no faces, a face refers to a vertex that is not there,
///              the size is beyond what areas and moments in double bear (1e-35 to 1e35), or no face has three corners
///              at distinct positions
void check_surface(const Surface& surface, const char* which = "mesh");

/// weld() of a checked surface; so there are faces afterwards.
/// \throw Error as check_surface()
[[nodiscard]] Welded checked_weld(Surface surface, const char* which = "mesh");

} // namespace vcg_ext
