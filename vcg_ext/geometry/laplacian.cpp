// SPDX-License-Identifier: GPL-3.0-or-later
#include "laplacian.h"

#include <algorithm>

namespace vcg_ext {

double laplacian_bound(const EdgeGraph& graph)
{
    int bound = 0;
    for (int v = 0; v < graph.vertices(); ++v)
        for (const int* w = graph.begin(v); w != graph.end(v); ++w)
            bound = std::max(bound, graph.degree(v) + graph.degree(*w));
    return bound;
}

} // namespace vcg_ext
