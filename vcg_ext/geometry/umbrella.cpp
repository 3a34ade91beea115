// SPDX-License-Identifier: GPL-3.0-or-later
#include "umbrella.h"

namespace vcg_ext {

Points taubin(const EdgeGraph& graph, Points points, int passes, double shrink, double inflate)
{
    for (int pass = 0; pass < passes; ++pass)
        for (const double part : {shrink, inflate})
            points = umbrella_step(graph, points, part);
    return points;
}

} // namespace vcg_ext
