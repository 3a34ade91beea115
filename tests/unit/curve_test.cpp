// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/geometry/curve.h"

#include "support/load.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <set>

using namespace vcg_ext;

namespace {

TEST(Curve, LeavesNoCellBeforeItIsThroughWithIt)
{
    const Surface s = load("elephant.off");
    const std::vector<int> order = curve_order(s.points);
    std::vector<int> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    std::vector<int> all(s.points.size());
    std::iota(all.begin(), all.end(), 0);
    ASSERT_EQ(sorted, all);
    const Eigen::AlignedBox3d box = bounding_box(s.points);
    for (const int cells : {2, 8, 64, 1024}) { // a side
        const auto cell = [&](int v) {
            std::array<int, 3> result{};
            for (int axis = 0; axis < 3; ++axis)
                result[axis] = std::min(
                    cells - 1, static_cast<int>((s.points[v] - box.min())[axis] / box.sizes().maxCoeff() * cells));
            return result;
        };
        std::set<std::array<int, 3>> seen;
        for (std::size_t i = 0; i < order.size(); ++i)
            if (i == 0 || cell(order[i]) != cell(order[i - 1])) {
                EXPECT_TRUE(seen.insert(cell(order[i])).second);
            } else {
                EXPECT_TRUE(cells < 1024 || order[i] > order[i - 1]);
            }
    }
}

TEST(Curve, TakesPointsThatAreAllTheSame)
{
    EXPECT_EQ(curve_order(Points(3, Point(1, 2, 3))), (std::vector<int>{0, 1, 2}));
    EXPECT_TRUE(curve_order({}).empty());
}

} // namespace
