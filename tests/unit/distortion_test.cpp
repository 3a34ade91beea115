// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/base/error.h"
#include "vcg_ext/base/progress.h"
#include "vcg_ext/metric/distortion.h"

#include "support/load.h"
#include "support/shapes.h"
#include "support/topology.h"
#include "vcg_ext/attack/attack.h"
#include "vcg_ext/base/parallel.h"
#include "vcg_ext/metric/displacement.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>

using namespace vcg_ext;

namespace {

Surface attacked(Surface surface, AttackOptions options)
{
    apply_attack(surface, options);
    return surface;
}

TEST(Distortion, OfNothingIsNothing)
{
    const Surface disk = load("fandisk.off");
    const DistortionReport r = measure(disk, disk);
    EXPECT_DOUBLE_EQ(r.diagonal, bounding_diagonal(disk));
    EXPECT_LT(r.mrms_relative, 1e-15);
    EXPECT_LT(r.hausdorff_relative, 1e-15);
    EXPECT_FALSE(r.snr_db);
    EXPECT_EQ(r.msdm, 0);
    EXPECT_EQ(r.volume_change, 0);
    EXPECT_EQ(r.area_change, 0);
    EXPECT_EQ(r.samples, 64750);
    EXPECT_TRUE(r.warnings.empty());
}

TEST(Distortion, OfABiggerSphere)
{
    // Between spheres of radius 1 and 1.01 all distances are 0.01. The polyhedra's faces stand back by up to 4e-4 and
    // 3e-4 at their middles, alike on both.
    const Surface ball = shapes::sphere(5);
    const Surface bigger = shapes::moved(ball, 1.01, 0, {0, 0, 1}, {0, 0, 0});
    const DistortionReport r = measure(ball, bigger);
    EXPECT_NEAR(r.mrms, 0.01, 2e-5);
    EXPECT_NEAR(r.mean, 0.01, 2e-5);
    EXPECT_NEAR(r.hausdorff, 0.01, 1e-4);
    EXPECT_NEAR(*r.volume_change, std::pow(1.01, 3) - 1, 1e-12);
    EXPECT_NEAR(r.area_change, std::pow(1.01, 2) - 1, 1e-12);
    EXPECT_NEAR(*r.snr_db, 40, 1e-9); // |v|^2 over (0.01 |v|)^2
    EXPECT_DOUBLE_EQ(r.mrms_relative, r.mrms / bounding_diagonal(ball));
    for (const double d : r.distance)
        EXPECT_NEAR(d, 0.01, 1e-4);
}

TEST(Distortion, OfATentAgainstItsFloor)
{
    // The unit square as four faces about its middle, and the same with the middle raised by h. A point of the tent at
    // the height z is z from the floor; on each face z is linear from 0 at the edge to h at the tip, so the mean is h /
    // 3 and the mean square h^2 / 6.
    const double h = 0.01;
    const std::vector<Triangle> faces = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    const Surface floor = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}}, faces};
    Surface tent = floor;
    tent.points[4].z() = h;
    DistortionOptions options;
    options.samples = 200000;
    const DistortionReport r = measure(floor, tent, options);
    EXPECT_NEAR(r.mrms, h / std::sqrt(6), 0.005 * h); // sampling; the sides' slope hides within
    EXPECT_NEAR(r.mean, h / 3, 0.005 * h);
    EXPECT_NEAR(r.hausdorff, h, 1e-6 * h);
    EXPECT_FALSE(r.volume_change);
    EXPECT_NEAR(r.area_change, std::sqrt(1 + 4 * h * h) - 1, 1e-12);
    EXPECT_NEAR(r.distance[4], h, 1e-6 * h);
    EXPECT_EQ(r.distance[0], 0);
}

TEST(Distortion, TakesTheLargerDirection)
{
    // One sphere, and the same with another one far off: only from the second does the other lie far.
    const Surface ball = shapes::sphere(2);
    const Surface two = joined(ball, shapes::moved(ball, 1, 0, {0, 0, 1}, {10, 0, 0}));
    const DistortionReport r = measure(ball, two);
    EXPECT_NEAR(r.hausdorff, 10, 0.2);
    EXPECT_GT(r.mrms, 5);
    EXPECT_NEAR(measure(two, ball).mrms, r.mrms, 0.02 * r.mrms);
    EXPECT_NEAR(*r.volume_change, 1, 1e-9);
}

TEST(Distortion, SameAnswerAgainAndAtAnyNumberOfThreads)
{
    const Surface disk = load("fandisk.off");
    for (const Attack attack : {Attack::Noise, Attack::Simplify}) {
        const Surface other = attacked(disk, {attack, -1, -1, 2});
        set_threads(1);
        const DistortionReport one = measure(disk, other);
        set_threads(3);
        const DistortionReport three = measure(disk, other);
        set_threads(0);
        EXPECT_EQ(one.mrms, three.mrms);
        EXPECT_EQ(one.hausdorff, three.hausdorff);
        EXPECT_EQ(one.mean, three.mean);
        EXPECT_EQ(one.msdm, three.msdm);
        EXPECT_EQ(one.snr_db, three.snr_db);
        EXPECT_EQ(one.distance, three.distance);
    }
}

TEST(Distortion, SeedsAndNumbersOfSamplesAgreeWithinTheirNoise)
{
    const Surface disk = load("fandisk.off");
    const Surface noisy = attacked(disk, {Attack::Noise, 0.003, -1, 2});
    const double first = measure(disk, noisy, {20000, 1}).mrms;
    EXPECT_NE(first, measure(disk, noisy, {20000, 2}).mrms);
    EXPECT_NEAR(first, measure(disk, noisy, {20000, 2}).mrms, 0.02 * first);
    EXPECT_NEAR(first, measure(disk, noisy, {200000, 3}).mrms, 0.02 * first);
}

TEST(Distortion, IsTheSameWithoutCorrespondence)
{
    // Reordering takes the counterparts away, not the shape: another way to the same numbers.
    const Surface disk = load("fandisk.off");
    const Surface noisy = attacked(disk, {Attack::Noise, 0.001, -1, 2});
    const Surface mixed = attacked(noisy, {Attack::Reorder, -1, -1, 3});
    const DistortionReport paired = measure(disk, noisy, {200000, 0});
    const DistortionReport unpaired = measure(disk, mixed, {200000, 0});
    EXPECT_NEAR(paired.mrms, unpaired.mrms, 0.01 * paired.mrms);
    EXPECT_NEAR(paired.hausdorff, unpaired.hausdorff, 0.05 * paired.hausdorff);
    EXPECT_NEAR(*paired.volume_change, *unpaired.volume_change, 1e-12);
    EXPECT_TRUE(paired.warnings.empty());
    EXPECT_EQ(unpaired.warnings.size(), 1u);
}

TEST(Distortion, SoupCountsAsTheWeldedMesh)
{
    const Surface ball = shapes::sphere(3);
    const Surface bigger = shapes::moved(ball, 1.01, 0, {0, 0, 1}, {0, 0, 0});
    const DistortionReport whole = measure(ball, bigger);
    const DistortionReport faces = measure(soup(ball), soup(bigger), {whole.samples, 0});
    EXPECT_EQ(whole.mrms, faces.mrms);
    EXPECT_EQ(whole.snr_db, faces.snr_db);
    EXPECT_EQ(faces.distance.size(), 3 * ball.triangles.size());
    EXPECT_GT(*std::min_element(faces.distance.begin(), faces.distance.end()), 0.009);
}

TEST(Distortion, AgreesWithTheNeighbourhoodsFigureForSmallMoves)
{
    const Surface disk = load("fandisk.off");
    const Surface noisy = attacked(disk, {Attack::Noise, 1e-4, -1, 2});
    const double near = local_mrms(disk.points, noisy.points, disk.triangles,
                                   vertex_faces(static_cast<int>(disk.points.size()), disk.triangles));
    EXPECT_NEAR(measure(disk, noisy).mrms, near, 0.02 * near);
}

TEST(Distortion, RefusesWhatIsNoSurface)
{
    const Surface ball = shapes::sphere(1);
    Surface infinite = ball;
    infinite.points[0].x() = std::numeric_limits<double>::quiet_NaN();
    for (const Surface& wrong : {Surface(), Surface{ball.points, {}}, infinite}) {
        EXPECT_THROW((void)measure(ball, wrong), Error);
        EXPECT_THROW((void)measure(wrong, ball), Error);
    }
    EXPECT_THROW((void)measure(ball, ball, {-1, 0}), Error);
    EXPECT_THROW((void)measure(ball, ball, {}, [](int, const char*) { return false; }), Cancelled);
}

TEST(Distortion, CanBeStoppedWithinEachPhase)
{
    const Surface ball = shapes::sphere(4);
    const Surface other = shapes::sphere(3);
    DistortionOptions options;
    options.samples = 100000;
    std::map<std::string, std::vector<int>> told;
    (void)measure(ball, other, options, [&](int percent, const char* phase) {
        told[phase].push_back(percent);
        return true;
    });
    std::vector<int> all;
    for (const char* phase : {"Search trees", "Reference to measured", "Measured to reference", "Vertices", "Curvature",
                              "Structural distance"}) {
        EXPECT_GE(told[phase].size(), 2u) << phase;
        EXPECT_TRUE(std::is_sorted(told[phase].begin(), told[phase].end())) << phase;
        all.insert(all.end(), told[phase].begin(), told[phase].end());
    }
    EXPECT_TRUE(std::is_sorted(all.begin(), all.end()));
    for (std::size_t last = 0; last < all.size(); last += 3) {
        std::size_t calls = 0;
        EXPECT_THROW((void)measure(ball, other, options, [&](int, const char*) { return calls++ < last; }), Cancelled);
        EXPECT_EQ(calls, last + 1);
    }
}

TEST(Distortion, TakesAsManySamplesAsThereAreNumbers)
{
    const Surface ball = shapes::sphere(1);
    DistortionOptions options;
    options.samples = std::numeric_limits<int>::max();
    int calls = 0;
    EXPECT_THROW((void)measure(ball, ball, options, [&](int, const char*) { return ++calls < 5; }), Cancelled);
}

} // namespace
