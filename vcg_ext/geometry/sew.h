// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "boundary.h"

namespace vcg_ext {

/// Per vertex another one that it lies together with, or itself: vertices of the boundary within `reach` of each other,
/// and within a quarter of the boundary's own edges there, so that sewing eats none of them.
///
/// A head is its own. \param edges the boundary
[[nodiscard]] std::vector<int> sewn_to(const Points& points, const std::vector<EdgeUse>& edges, double reach);

} // namespace vcg_ext
