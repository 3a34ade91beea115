// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "body.h"

namespace vcg_ext {

/// The vertices, ring after ring about the first of each connected piece (breadth first): neighbours are never further
/// apart than two rings are long.
[[nodiscard]] std::vector<int> ring_order(int vertices, const std::vector<Triangle>& triangles);

/// renumber()s the body's sites by rings.
void number_by_rings(Body& body);

} // namespace vcg_ext
