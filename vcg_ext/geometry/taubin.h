#pragma once
#include "laplacian.h"

namespace vcg_ext {

/// Low-pass without shrinking (Taubin 1995): each pass moves every vertex by `shrink`, then by `inflate`, of the way to
/// its neighbours' mean. Vertices without neighbours stay.
///
/// \param shrink in (0, 1)   \param inflate below -shrink
[[nodiscard]] Points taubin(const EdgeGraph& graph, Points points, int passes, double shrink = 0.5,
                            double inflate = -0.53);

} // namespace vcg_ext
