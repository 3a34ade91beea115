// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/attack/mirror.h"

#include "support/load.h"
#include "vcg_ext/geometry/moments.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

TEST(Mirror, IsItsOwnInverseAndKeepsTheOutsideOutside)
{
    const Surface disk = load("fandisk.off");
    const Surface image = mirror(disk);
    EXPECT_EQ(mirror(image).points, disk.points);
    EXPECT_EQ(mirror(image).triangles, disk.triangles);
    EXPECT_NEAR(signed_volume(image), signed_volume(disk), 1e-9 * std::abs(signed_volume(disk)));
    EXPECT_EQ(image.points[7].x(), -disk.points[7].x());
    EXPECT_EQ(image.points[7].z(), disk.points[7].z());
}

} // namespace
