// SPDX-License-Identifier: GPL-3.0-or-later
#include "laplacian.h"

#include "../base/parallel.h"

#include <algorithm>

namespace vcg_ext {

double laplacian_bound(const EdgeGraph& graph)
{
    return ordered_maximum(graph.vertices(), 0, [&](int v) {
        int most = 0;
        for (const int* w = graph.begin(v); w != graph.end(v); ++w)
            most = std::max(most, graph.degree(*w));
        return most > 0 ? graph.degree(v) + most : 0;
    });
}

} // namespace vcg_ext
