// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

#include <vector>

namespace vcg_ext {

/// Some vertices, ascending, and where each was before it moved.
struct Moves {
    std::vector<int> vertices;
    Points before;
};

/// Puts vertices back to where they were.
void take_back(const Moves& moves, Points& points);

/// The moves of both, one after the other: a vertex that moved twice was where the first has it.
[[nodiscard]] Moves joined(const Moves& first, const Moves& second);

} // namespace vcg_ext
