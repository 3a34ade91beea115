// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "edge_graph.h"

#include <functional>

namespace vcg_ext {

/// Calls `take(k, begin, end)` for the rows [begin, end) of each step k of [first, last), each row once: several steps
/// over rows that are near, so that these are still in the processor's cache when they come again. That needs vertices
/// that are numbered so that neighbours are near each other, as by rings.
///
/// When row v of step k comes, step k - 1 is there at v and all its neighbours, and they are the last that need step
/// k - 2 at v: step k may take its place. `take` is called on several threads; rows are written by one alone, so the
/// result is the same at any number of them.
void take_steps(const EdgeGraph& graph, int first, int last,
                const std::function<void(int step, int begin, int end)>& take);

} // namespace vcg_ext
