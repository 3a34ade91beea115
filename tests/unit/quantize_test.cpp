// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/attack/quantize.h"

#include "support/load.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace vcg_ext;

namespace {

TEST(Quantize, LeavesAtMostSoManyValuesPerAxis)
{
    const Points points = load("bunny00.off").points;
    for (const int bits : {2, 7, 10}) {
        const Points rounded = quantize(points, bits);
        for (int axis = 0; axis < 3; ++axis) {
            std::set<double> values;
            for (const Point& p : rounded)
                values.insert(p[axis]);
            EXPECT_LE(values.size(), std::size_t(1) << bits);
            EXPECT_GT(values.size(), std::size_t(1) << (bits - 1));
        }
    }
}

TEST(Quantize, MovesByAtMostHalfAStepAndKeepsTheExtent)
{
    const Points points = load("fandisk.off").points;
    const Points rounded = quantize(points, 9);
    for (int axis = 0; axis < 3; ++axis) {
        const auto less = [axis](const Point& a, const Point& b) { return a[axis] < b[axis]; };
        const auto [low, high] = std::minmax_element(points.begin(), points.end(), less);
        const double extent = (*high)[axis] - (*low)[axis];
        for (std::size_t v = 0; v < points.size(); ++v)
            EXPECT_LE(std::abs(rounded[v][axis] - points[v][axis]), extent / 511 / 2 * (1 + 1e-12));
        const auto [new_low, new_high] = std::minmax_element(rounded.begin(), rounded.end(), less);
        EXPECT_EQ((*new_low)[axis], (*low)[axis]);
        EXPECT_NEAR((*new_high)[axis], (*high)[axis], 1e-15 * extent);
    }
}

TEST(Quantize, TwiceIsOnce)
{
    const Points once = quantize(load("fandisk.off").points, 8);
    const Points twice = quantize(once, 8);
    for (std::size_t v = 0; v < once.size(); ++v)
        EXPECT_LT((once[v] - twice[v]).norm(), 1e-14 * once[v].norm());
}

TEST(Quantize, FlatAxisStays)
{
    for (const Point& p : quantize({{0, 5, 1}, {1, 5, 2}, {2, 5, 4}}, 3))
        EXPECT_EQ(p.y(), 5);
}

} // namespace
