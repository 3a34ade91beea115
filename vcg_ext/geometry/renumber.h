// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "body.h"

namespace vcg_ext {

/// Numbers the body's sites in this order, and its faces by their first sites. What goes from neighbour to neighbour
/// needs them near each other in memory: a scanner's file, and more so a subdivided mesh, has them anywhere, and each
/// look at one is a wait.
/// \param order each site once
void renumber(Body& body, const std::vector<int>& order);

} // namespace vcg_ext
