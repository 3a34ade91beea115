// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/progress.h"
#include "../geometry/parts.h"
#include "report.h"

#include <functional>

namespace vcg_ext {

/// The connected pieces of a mesh that are looked at by themselves where the whole gives nothing: the 16 largest of
/// those that have a hundredth of the area; none where there is one only.
[[nodiscard]] std::vector<Part> pieces_to_look_at(const Surface& surface);

/// How much of the doubt a mesh as a whole has: half of it where pieces of it are looked at too.
[[nodiscard]] inline double share_of_whole(const std::vector<Part>& pieces)
{
    return pieces.empty() ? 1 : 0.5;
}

/// What is read of a piece, whose probabilities have been divided by `share`.
using PieceReader = std::function<DetectReport(const Surface& piece, double share, const Progress& progress)>;

/// Looks at the pieces, each with an equal share of half of the doubt; `result` becomes the best of them where that
/// says more, and keeps what was said of each.
void look_at_pieces(const PieceReader& read, const std::vector<Part>& pieces, DetectReport& result,
                    const Progress& progress);

} // namespace vcg_ext
