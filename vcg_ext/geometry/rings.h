// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "body.h"

namespace vcg_ext {

/// The vertices, ring after ring about the first of each connected piece (breadth first): neighbours are never further
/// apart than two rings are long.
[[nodiscard]] std::vector<int> ring_order(int vertices, const std::vector<Triangle>& triangles);

/// Renumbers the body's sites by rings, and its faces by their first sites, so that neighbours lie near each other in
/// memory. What goes from neighbour to neighbour needs it: a scanner's file, and more so a subdivided mesh, has them
/// anywhere, and each look at one is a wait.
void number_by_rings(Body& body);

} // namespace vcg_ext
