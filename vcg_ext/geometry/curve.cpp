// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve.h"

#include "../base/parallel.h"
#include "renumber.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace vcg_ext {

namespace {

constexpr int bits = 10; ///< of a coordinate

/// Two zeros before each bit.
std::uint32_t spread(std::uint32_t x)
{
    x = (x | x << 16) & 0x030000FFU;
    x = (x | x << 8) & 0x0300F00FU;
    x = (x | x << 4) & 0x030C30C3U;
    return (x | x << 2) & 0x09249249U;
}

} // namespace

std::vector<int> curve_order(const Points& points)
{
    const int count = static_cast<int>(points.size());
    const Eigen::AlignedBox3d box = bounding_box(points);
    const double size = count > 0 ? box.sizes().maxCoeff() : 0;
    constexpr int last = (1 << bits) - 1;
    std::vector<std::uint32_t> cell(count, 0);
    if (size > 0)
        for_each_index(count, [&](int v) {
            for (int axis = 0; axis < 3; ++axis) {
                const double place = (points[v][axis] - box.min()[axis]) / size * (last + 1);
                cell[v] |= spread(static_cast<std::uint32_t>(std::clamp(place, 0.0, 1.0 * last))) << axis;
            }
        });
    std::vector<int> order(count);
    std::iota(order.begin(), order.end(), 0);
    constexpr int digit = 3 * bits / 2;
    for (const int shift : {0, digit}) { // from the lower digit on
        const auto value = [&](int v) { return cell[v] >> shift & ((1U << digit) - 1); };
        std::vector<int> next((1 << digit) + 1, 0);
        for (const int v : order)
            ++next[value(v) + 1];
        std::partial_sum(next.begin(), next.end(), next.begin());
        std::vector<int> sorted(count);
        for (const int v : order)
            sorted[next[value(v)]++] = v;
        order = std::move(sorted);
    }
    return order;
}

void number_by_curve(Body& body)
{
    renumber(body, curve_order(body.surface.points));
}

} // namespace vcg_ext
