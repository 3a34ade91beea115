// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/attack/reorder.h"

#include "support/load.h"
#include "support/topology.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace vcg_ext;

namespace {

/// Every face by the positions of its corners, beginning at the least: what the geometry is, in no order.
std::vector<std::array<double, 9>> geometry(const Surface& surface)
{
    std::vector<std::array<double, 9>> faces;
    for (const Triangle& t : surface.triangles) {
        std::array<std::array<double, 3>, 3> corners;
        for (int k = 0; k < 3; ++k)
            corners[k] = {surface.points[t[k]].x(), surface.points[t[k]].y(), surface.points[t[k]].z()};
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        std::array<double, 9> flat;
        for (int i = 0; i < 9; ++i)
            flat[i] = corners[i / 3][i % 3];
        faces.push_back(flat);
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

TEST(Reorder, KeepsTheGeometryBitForBit)
{
    const Surface disk = load("fandisk.off");
    const Surface mixed = reorder(disk, 5);
    EXPECT_NE(mixed.points, disk.points);
    EXPECT_NE(mixed.triangles, disk.triangles);
    EXPECT_EQ(mixed.points.size(), disk.points.size());
    EXPECT_EQ(geometry(mixed), geometry(disk));
    EXPECT_TRUE(is_closed_manifold(mixed));
}

} // namespace
