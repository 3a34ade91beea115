// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/attack/similarity.h"

#include "support/load.h"
#include "vcg_ext/geometry/moments.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

TEST(Similarity, ScalesAllEdgesAlikeAndKeepsTheHandedness)
{
    const Surface disk = load("fandisk.off");
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Surface moved = {similarity(disk.points, seed), disk.triangles};
        const double scale = std::cbrt(signed_volume(moved, moved.points[0]) / signed_volume(disk, disk.points[0]));
        EXPECT_GE(scale, 0.5);
        EXPECT_LE(scale, 2);
        for (const Triangle& t : disk.triangles) {
            const double before = (disk.points[t[0]] - disk.points[t[1]]).norm();
            const double after = (moved.points[t[0]] - moved.points[t[1]]).norm();
            EXPECT_NEAR(after / before, scale, 1e-5 * scale);
        }
    }
}

TEST(Similarity, RotationsReachEveryDirection)
{
    // The image of the x axis under a uniform rotation is uniform on the sphere: mean 0 within five standard errors.
    constexpr int draws = 2000;
    Point mean = Point::Zero();
    for (int seed = 0; seed < draws; ++seed) {
        const Points ends = similarity({{0, 0, 0}, {1, 0, 0}}, seed);
        mean += (ends[1] - ends[0]).normalized() / draws;
    }
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(mean[axis], 0, 5 / std::sqrt(3.0 * draws));
}

} // namespace
