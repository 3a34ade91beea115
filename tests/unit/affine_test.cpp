// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/attack/affine.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>

using namespace vcg_ext;

namespace {

TEST(Affine, LargestRelativeChangeIsTheAmount)
{
    // About the box' centre (1, 1, 1), the unit vectors' images are the columns of the map.
    const Points corners = {{0, 0, 0}, {2, 2, 2}, {1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2}};
    for (const double amount : {0.01, 0.1, 0.5})
        for (std::uint64_t seed = 0; seed < 10; ++seed) {
            const Points moved = affine(corners, amount, seed);
            Eigen::Matrix3d map;
            for (int k = 0; k < 3; ++k)
                map.col(k) = moved[3 + k] - moved[2];
            const Eigen::Matrix3d change = map - Eigen::Matrix3d::Identity();
            EXPECT_NEAR(Eigen::JacobiSVD<Eigen::Matrix3d>(change).singularValues()[0], amount, 1e-12);
            EXPECT_EQ(moved[2], corners[2]);
            EXPECT_GT(map.determinant(), 0);
        }
}

} // namespace
