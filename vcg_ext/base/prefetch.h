// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "surface.h"

namespace vcg_ext {

/// How many elements before its turn to fetch what an element refers to. A scanner's file, and more so a subdivided
/// mesh, has neighbours anywhere in memory: a loop that asks for them in their turn waits for most of its time.
constexpr int elements_ahead = 48;

/// Has memory fetched that will be read; nothing depends on it but time.
inline void prefetch(const void* address)
{
    __builtin_prefetch(address);
}

/// The corners of the face whose turn comes some faces after that of `face`.
inline void prefetch_corners(const Points& points, const std::vector<Triangle>& triangles, int face)
{
    const std::size_t later = static_cast<std::size_t>(face) + elements_ahead;
    if (later < triangles.size())
        for (const int v : triangles[later])
            prefetch(&points[v]);
}

} // namespace vcg_ext
