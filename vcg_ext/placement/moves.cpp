// SPDX-License-Identifier: GPL-3.0-or-later
#include "moves.h"

#include "../base/parallel.h"

namespace vcg_ext {

void take_back(const Moves& moves, Points& points)
{
    for_each_index(static_cast<int>(moves.vertices.size()),
                   [&](int i) { points[moves.vertices[i]] = moves.before[i]; });
}

Moves joined(const Moves& first, const Moves& second)
{
    Moves all;
    const auto add = [&all](const Moves& moves, std::size_t i) {
        all.vertices.push_back(moves.vertices[i]);
        all.before.push_back(moves.before[i]);
    };
    std::size_t next = 0;
    for (std::size_t i = 0; i < second.vertices.size(); ++i) {
        while (next < first.vertices.size() && first.vertices[next] < second.vertices[i])
            add(first, next++);
        if (next == first.vertices.size() || first.vertices[next] != second.vertices[i])
            add(second, i);
    }
    while (next < first.vertices.size())
        add(first, next++);
    return all;
}

} // namespace vcg_ext
