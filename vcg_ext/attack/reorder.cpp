// SPDX-License-Identifier: GPL-3.0-or-later
#include "reorder.h"

#include "../key/random.h"
#include "../key/stream.h"

#include <algorithm>

namespace vcg_ext {

Surface reorder(const Surface& surface, std::uint64_t seed)
{
    Stream stream = seeded_stream(seed, "reorder");
    const std::vector<int> place = stream.permutation(static_cast<int>(surface.points.size()));
    const std::vector<int> source = stream.permutation(static_cast<int>(surface.triangles.size()));
    Surface result;
    result.points.resize(surface.points.size());
    for (std::size_t v = 0; v < place.size(); ++v)
        result.points[place[v]] = surface.points[v];
    result.triangles.reserve(source.size());
    for (const int f : source) {
        Triangle t = surface.triangles[f];
        for (int& v : t)
            v = place[v];
        std::rotate(t.begin(), t.begin() + static_cast<int>(stream.below(3)), t.end());
        result.triangles.push_back(t);
    }
    return result;
}

} // namespace vcg_ext
