// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "body.h"

namespace vcg_ext {

/// The points along a curve that fills their box (Z-order, Morton 1966): those in one cell of a grid of 1024 a side
/// follow each other, and so do those in each larger one. Points in the same cell stay in their order.
[[nodiscard]] std::vector<int> curve_order(const Points& points);

/// renumber()s the body's sites along that curve: what is near in space is near in memory. For what moves over the
/// surface on a front wherever that goes; what takes all vertices in turn does better with number_by_rings().
void number_by_curve(Body& body);

} // namespace vcg_ext
