// SPDX-License-Identifier: GPL-3.0-or-later
#include "crop.h"

#include "../key/random.h"
#include "../key/stream.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vcg_ext {

Surface crop(const Surface& surface, double amount, std::uint64_t seed)
{
    Stream stream = seeded_stream(seed, "crop");
    const Point normal = direction<3>(stream);
    const std::size_t faces = surface.triangles.size();
    std::vector<double> height(faces);
    for (std::size_t f = 0; f < faces; ++f)
        for (const int v : surface.triangles[f])
            height[f] += normal.dot(surface.points[v]);

    std::vector<int> order(faces);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), // equal heights: by number, so that the cut does not depend on the sort
              [&](int a, int b) { return height[a] != height[b] ? height[a] < height[b] : a < b; });
    const auto kept = faces - static_cast<std::size_t>(std::floor(amount * static_cast<double>(faces) + 0.5));
    order.resize(std::max<std::size_t>(kept, 1));
    std::sort(order.begin(), order.end());

    Surface result;
    std::vector<int> place(surface.points.size(), -1);
    for (const int f : order)
        for (const int v : surface.triangles[f])
            place[v] = 0;
    for (std::size_t v = 0; v < place.size(); ++v)
        if (place[v] == 0) {
            place[v] = static_cast<int>(result.points.size());
            result.points.push_back(surface.points[v]);
        }
    for (const int f : order) {
        const Triangle& t = surface.triangles[f];
        result.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
    }
    return result;
}

} // namespace vcg_ext
