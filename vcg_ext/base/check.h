#pragma once
#include "weld.h"

namespace vcg_ext {

/// \param which what the text calls the mesh
/// \throw Error where a coordinate is not finite, the mesh has no faces, a face refers to a vertex that is not there,
/// or its size is beyond what areas and moments in double bear (1e-35 to 1e35)
void check_surface(const Surface& surface, const char* which = "mesh");

/// weld(), checked before and after. \throw Error as check_surface(), and where no face has three distinct corners
[[nodiscard]] Welded checked_weld(const Surface& surface, const char* which = "mesh");

} // namespace vcg_ext
