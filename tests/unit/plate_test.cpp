// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/attack/plate.h"

#include "support/load.h"
#include "vcg_ext/geometry/moments.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

TEST(Plate, HoldsCopiesThatDoNotTouch)
{
    const Surface disk = load("fandisk.off");
    const int vertices = static_cast<int>(disk.points.size());
    const Surface five = plate(disk, 5, 1);
    ASSERT_EQ(five.points.size(), 5 * disk.points.size());
    EXPECT_NEAR(signed_volume(five), 5 * signed_volume(disk), 1e-9 * std::abs(signed_volume(five)));
    std::vector<Eigen::AlignedBox3d> boxes(5);
    for (std::size_t v = 0; v < five.points.size(); ++v)
        boxes[v / vertices].extend(five.points[v]);
    for (int copy = 1; copy < 5; ++copy)
        EXPECT_FALSE(boxes[copy].intersects(boxes[copy - 1]));
    for (const Triangle& t : five.triangles)
        EXPECT_TRUE(t[0] / vertices == t[1] / vertices && t[0] / vertices == t[2] / vertices);
    // Turned about z: heights stay, edges keep their lengths, and no two copies lie alike.
    for (int v = 0; v < vertices; v += 97) {
        EXPECT_NEAR(five.points[v].z(), disk.points[v].z(), 1e-12);
        EXPECT_NEAR((five.points[v] - five.points[0]).norm(), (disk.points[v] - disk.points[0]).norm(), 1e-9);
    }
    EXPECT_GT((five.points[7] - five.points[0] - (five.points[vertices + 7] - five.points[vertices])).norm(), 1e-3);
}

} // namespace
