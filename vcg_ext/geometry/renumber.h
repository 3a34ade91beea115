// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "body.h"

namespace vcg_ext {

/// Numbers sites in this order, and faces by their first sites. What goes from neighbour to neighbour needs them near
/// each other in memory: a scanner's file, and more so a subdivided mesh, has them anywhere, and each look at one is a
/// wait.
/// \param site_of_vertex as a Body's  \param order each site once
void renumber(Surface& surface, std::vector<int>& site_of_vertex, const std::vector<int>& order);

/// The same with a body's sites.
inline void renumber(Body& body, const std::vector<int>& order)
{
    renumber(body.surface, body.site_of_vertex, order);
}

} // namespace vcg_ext
