// SPDX-License-Identifier: GPL-3.0-or-later
#include "umbrella.h"

namespace vcg_ext {

Points taubin(const EdgeGraph& graph, Points points, int passes, double shrink, double inflate)
{
    return umbrella_series(graph, std::move(points), 2 * passes,
                           [=](int step) { return step % 2 == 0 ? shrink : inflate; });
}

} // namespace vcg_ext
