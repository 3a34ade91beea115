// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/geometry/registration.h"

#include "support/load.h"
#include "support/shapes.h"
#include "vcg_ext/attack/affine.h"
#include "vcg_ext/attack/attack.h"
#include "vcg_ext/attack/crop.h"
#include "vcg_ext/geometry/icp.h"
#include "vcg_ext/key/random.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

Surface moved_far(const Surface& surface)
{
    return shapes::moved(shapes::renumbered(surface, 5), 2.5, 2.1, Point(1, 2, -3), Point(7, -4, 11));
}

Surface mirror(Surface surface)
{
    for (Point& p : surface.points)
        p.x() = -p.x();
    return surface;
}

/// RMS distance of points from where they were before `moved`, over the diagonal.
double error_of(const Eigen::Affine3d& pose, const Surface& moved, const Surface& before)
{
    double squares = 0;
    for (std::size_t v = 0; v < moved.points.size(); ++v)
        squares += (pose * moved.points[v] - before.points[v]).squaredNorm();
    return std::sqrt(squares / static_cast<double>(moved.points.size())) / bounding_diagonal(before);
}

Registration registered(const Surface& surface, const Surface& original)
{
    const FootSearch feet(original);
    return Registrar(feet)(surface);
}

} // namespace

TEST(Feet, AreWeightedMeansOfTheirFacesAndKnowTheBorder)
{
    const Surface grid = shapes::triangular_grid(3, 2, 0.25);
    const FootSearch feet(grid);
    Stream draws = seeded_stream(0, "feet");
    for (int i = 0; i < 500; ++i) {
        const auto in = [&](double low, double high) {
            return low + (high - low) * static_cast<double>(draws.below(1000)) / 1000;
        };
        const Point p(in(0.5, 2.5), in(0.5, 1.5), in(-0.1, 0.1));
        const Foot foot = feet(p, 1);
        ASSERT_GE(foot.face, 0);
        EXPECT_FALSE(foot.on_rim);
        EXPECT_NEAR(foot.distance, std::abs(p.z()), 1e-7);
        EXPECT_NEAR((weighted_point(grid, foot.face, foot.weights) - foot.point).norm(), 0, 1e-12);
        EXPECT_NEAR((foot.point - Point(p.x(), p.y(), 0)).norm(), 0, 1e-7);
    }
    EXPECT_TRUE(feet(Point(1.3, -0.2, 0), 1).on_rim);
    EXPECT_EQ(feet(Point(1.3, 1, 5), 1).face, -1);
}

TEST(Registration, FindsASimilarityExactly)
{
    for (const char* mesh : {"fandisk.off", "bunny00.off"}) {
        const Surface original = load(mesh);
        const Surface turned = shapes::moved(original, 2.5, 2.1, Point(1, 2, -3), Point(7, -4, 11));
        const Registration found = registered(turned, original);
        EXPECT_TRUE(found.found) << mesh;
        EXPECT_FALSE(found.mirrored());
        EXPECT_FALSE(found.inside_out);
        EXPECT_NEAR(found.scale(), 2.5, 1e-6);
        EXPECT_GT(found.overlap, 0.999);
        EXPECT_LT(error_of(found.pose, turned, original), 1e-7) << mesh;
        EXPECT_LT(error_of(found.affine, turned, original), 1e-7) << mesh;
        EXPECT_LT(found.residual, 1e-7);
    }
}

TEST(Registration, FindsACopyOfAnotherUnitThatLiesOnTheOriginal)
{
    const Surface original = load("fandisk.off");
    for (const double unit : {0.001, 0.01, 25.4}) {
        Surface copy = original;
        const Point place = original.points[17]; // where a small one is near the original as it is
        for (Point& p : copy.points)
            p = place + unit * (p - place);
        const Registration found = registered(copy, original);
        ASSERT_TRUE(found.found) << unit;
        EXPECT_NEAR(found.scale() / unit, 1, 1e-6) << unit;
        EXPECT_LT(error_of(found.pose, copy, original), 1e-6) << unit;
    }
}

TEST(Registration, FindsAMirrorImage)
{
    const Surface original = load("fandisk.off");
    const Surface turned = mirror(shapes::moved(original, 0.4, 1, Point(1, 0, 2), Point(3, 0, 0)));
    const Registration found = registered(turned, original);
    EXPECT_TRUE(found.found);
    EXPECT_TRUE(found.mirrored());
    EXPECT_TRUE(found.inside_out); // coordinates alone were mirrored, so its faces look in
    EXPECT_LT(error_of(found.affine, turned, original), 1e-7);
}

TEST(Registration, FindsAStretchedCopyThatNoSimilarityCovers)
{
    const Surface original = load("armadillo.off");
    for (const std::uint64_t seed : {1, 2}) {
        Surface copy = original;
        AttackOptions affine{Attack::Affine, 0.05};
        affine.seed = seed;
        (void)apply_attack(copy, affine);
        const Registration found = registered(copy, original);
        ASSERT_TRUE(found.found) << seed << ": " << found.overlap;
        EXPECT_LT(error_of(found.affine, copy, original), 1e-6) << seed;
    }
}

TEST(Registration, FindsAnAffineMapWithTwelveUnknownsOnly)
{
    const Surface original = load("bunny00.off");
    Eigen::Affine3d map = Eigen::Affine3d::Identity();
    map.linear() << 1.04, 0.02, 0, -0.03, 0.97, 0.01, 0.02, 0, 1.02;
    map.translation() << 0.1, 0.2, -0.1;
    Surface stretched = original;
    for (Point& p : stretched.points)
        p = map * p;
    const Registration found = registered(stretched, original);
    EXPECT_TRUE(found.found);
    EXPECT_LT(error_of(found.affine, stretched, original), 1e-7);
    EXPECT_GT(found.stretched_less, 10);
}

TEST(Registration, FindsAPieceByItsShapes)
{
    const Surface original = load("bunny00.off");
    const Surface piece = crop(original, 0.6, 3);
    const Surface turned = moved_far(piece);
    const Registration found = registered(turned, original);
    EXPECT_TRUE(found.found);
    EXPECT_STREQ(found.by, "features");
    EXPECT_NEAR(found.scale(), 2.5, 1e-4);
    EXPECT_LT(found.residual, 1e-6);
}
