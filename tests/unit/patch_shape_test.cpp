// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/placement/patch_shape.h"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

namespace {

using namespace vcg_ext;

/// A cloud of coefficients with standard deviations 3, 2, 1 about the origin in some rotation, and normals of a sphere.
struct Cloud {
    Points band;
    Points normals;
    std::vector<int> vertices;

    explicit Cloud(int count, bool flat = false)
    {
        std::mt19937 bits(7);
        const auto uniform = [&] { return bits() / 4294967296.0 * 2 - 1; };
        const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.8, Point(1, -2, 0.5).normalized()).toRotationMatrix();
        for (int i = 0; i < count; ++i) {
            band.emplace_back(rotation * Point(3 * uniform(), 2 * uniform(), uniform()));
            const Point n(uniform(), uniform(), uniform());
            normals.emplace_back(flat ? Point::Zero() : n.normalized());
        }
        vertices.resize(count);
        std::iota(vertices.begin(), vertices.end(), 0);
    }

    [[nodiscard]] PatchShape shape() const { return patch_shape(band, vertices); }

    [[nodiscard]] Cloud moved(const Points& moves) const
    {
        Cloud other = *this;
        for (std::size_t i = 0; i < moves.size(); ++i)
            other.band[i] += moves[i];
        return other;
    }

    /// Sum of squares of what leaves the surface.
    [[nodiscard]] double off_surface(const Points& moves) const
    {
        double sum = 0;
        for (std::size_t i = 0; i < moves.size(); ++i)
            sum += std::pow(normals[i].dot(moves[i]), 2);
        return sum;
    }
};

double sum_of_squares(const Points& moves)
{
    return std::accumulate(moves.begin(), moves.end(), 0.0,
                           [](double sum, const Point& d) { return sum + d.squaredNorm(); });
}

TEST(PatchShape, IsTheEllipsoidOfItsPoints)
{
    const Points band = {{3, 0, 0}, {-3, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, 1}, {0, 0, -1}};
    const PatchShape shape = patch_shape(band, {0, 1, 2, 3, 4, 5});
    EXPECT_LT((shape.variances - Point(18, 8, 2) / 6).norm(), 1e-14);
    EXPECT_NEAR(shape.ratio(), 9, 1e-12);
    EXPECT_EQ(patch_shape(band, {}).ratio(), 1);
    EXPECT_EQ(patch_shape(band, {0}).ratio(), 1e6);
}

TEST(PatchShape, PrintedChangeGivesThePrintedRatios)
{
    const Cloud cloud(200);
    for (const double ratio : {15.0, 1.0}) {
        const PatchShape after = cloud.moved(printed_change(cloud.shape(), cloud.band, cloud.vertices, ratio)).shape();
        EXPECT_NEAR(after.ratio(), ratio, 1e-9 * ratio);
        EXPECT_NEAR(after.variances[0], cloud.shape().variances[0], 1e-9); // (3.21) leaves the largest axis
    }
}

TEST(PatchShape, LeastChangeReachesItsRatio)
{
    const Cloud cloud(300);
    const auto after = [&](bool squash, double ratio) {
        return cloud.moved(least_change(cloud.shape(), cloud.band, cloud.normals, cloud.vertices, squash, ratio, 0))
            .shape();
    };
    EXPECT_GE(after(true, 15).ratio(), 15 * 0.99);
    EXPECT_LE(after(true, 15).ratio(), 15 * 1.2); // more where the axes turn a little
    EXPECT_LE(after(false, 1.1).ratio(), 1.3);
}

TEST(PatchShape, WithoutNormalsItIsTheClosedForm)
{
    // min (s1' - s1)^2 + (s3' - s3)^2 with s1' = r s3' has s3' = (r s1 + s3) / (r^2 + 1); axis 2 stays.
    const Cloud cloud(300, true);
    const PatchShape before = cloud.shape();
    const double ratio = 15;
    const PatchShape after =
        cloud.moved(least_change(before, cloud.band, cloud.normals, cloud.vertices, true, ratio, 0)).shape();
    const double r = std::sqrt(ratio);
    const double s3 = (r * std::sqrt(before.variances[0]) + std::sqrt(before.variances[2])) / (ratio + 1);
    EXPECT_NEAR(std::sqrt(after.variances[0]), r * s3, 0.01 * r * s3);
    EXPECT_NEAR(std::sqrt(after.variances[1]), std::sqrt(before.variances[1]), 1e-9);
    EXPECT_NEAR(std::sqrt(after.variances[2]), s3, 0.01 * s3);
}

TEST(PatchShape, IsTheLeastAmongChangesOfTheSameRatio)
{
    // Any other move to the same ratio costs more: here scalings of the axes, of which (3.21) and the closed
    // form are two.
    const Cloud cloud(300);
    const PatchShape shape = cloud.shape();
    const double ratio = 15;
    const Points least = least_change(shape, cloud.band, cloud.normals, cloud.vertices, true, ratio, 0);
    const double softness = 0.05;
    const double cost = cloud.off_surface(least) + softness * sum_of_squares(least);
    for (double third = 0.05; third < 1; third += 0.05) {
        const double first = std::sqrt(ratio * shape.variances[2] / shape.variances[0]) * third;
        const Eigen::Matrix3d change =
            shape.axes * Point(first - 1, 0, third - 1).asDiagonal() * shape.axes.transpose();
        Points moves;
        for (const Point& h : cloud.band)
            moves.emplace_back(change * h);
        EXPECT_GT(cloud.off_surface(moves) + softness * sum_of_squares(moves), 0.99 * cost) << third;
    }
    EXPECT_LT(cloud.off_surface(least),
              cloud.off_surface(printed_change(shape, cloud.band, cloud.vertices, ratio)) / 2);
}

TEST(PatchShape, LeavesAloneWhatFulfilsItsCondition)
{
    const Cloud cloud(300);
    const double ratio = cloud.shape().ratio();
    EXPECT_EQ(
        sum_of_squares(least_change(cloud.shape(), cloud.band, cloud.normals, cloud.vertices, true, ratio / 1.1, 0)),
        0);
    EXPECT_EQ(
        sum_of_squares(least_change(cloud.shape(), cloud.band, cloud.normals, cloud.vertices, false, ratio * 1.1, 0)),
        0);
}

TEST(PatchShape, RaisesTheEnergyWhereItIsTooLow)
{
    const Cloud cloud(300);
    for (const bool squash : {true, false}) {
        const int axis = squash ? 0 : 2;
        const double energy = 2 * cloud.shape().variances[axis];
        const PatchShape after = cloud
                                     .moved(least_change(cloud.shape(), cloud.band, cloud.normals, cloud.vertices,
                                                         squash, squash ? 15 : 1.1, energy))
                                     .shape();
        EXPECT_GE(after.variances[axis], 0.99 * energy);
        EXPECT_TRUE(squash ? after.ratio() > 14 : after.ratio() < 1.3) << after.ratio();
    }
}

} // namespace
