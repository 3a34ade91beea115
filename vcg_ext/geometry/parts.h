// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// Per vertex the lowest of those that it hangs together with by faces.
[[nodiscard]] std::vector<int> pieces_of(const Surface& surface);

/// A connected piece of a surface.
struct Part {
    Surface surface;
    double area_share = 0; ///< of the whole's area
};

/// The pieces whose faces hang together by vertices, by descending area; of equal ones that with the lower vertex first.
///
/// \param most        pieces, the rest is left out
/// \param least_share of the area that a piece must have
[[nodiscard]] std::vector<Part> connected_parts(const Surface& surface, int most, double least_share);

} // namespace vcg_ext
