// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/key/stream.h"
#include "vcg_ext/metric/perceptual.h"

#include "support/load.h"
#include "support/shapes.h"
#include "vcg_ext/attack/noise.h"
#include "vcg_ext/attack/reorder.h"
#include "vcg_ext/key/random.h"
#include "vcg_ext/metric/distortion.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

TEST(Curvature, OfASphereIsOneOverItsRadius)
{
    for (const double radius : {1e-3, 1.0, 1e3}) {
        const Surface ball = shapes::moved(shapes::sphere(4), radius, 0.3, {1, 2, 3}, {radius, 0, 0});
        for (const double k : mean_curvature(ball))
            EXPECT_NEAR(k * radius, 1, 0.02);
    }
}

TEST(Curvature, OfAPlaneIsNone)
{
    Surface grid = shapes::triangular_grid(1, 1, 0.1);
    grid = shapes::moved(grid, 1, 0.7, {1, 2, 3}, {0, 0, 0});
    const VertexFaces around = vertex_faces(static_cast<int>(grid.points.size()), grid.triangles);
    const std::vector<double> k = mean_curvature(grid);
    int inner = 0;
    for (int v = 0; v < static_cast<int>(k.size()); ++v) {
        ASSERT_TRUE(std::isfinite(k[v]));
        if (around.count(v) < 6)
            continue; // at a border the sum over the faces is no curvature
        EXPECT_LT(k[v], 1e-9);
        ++inner;
    }
    EXPECT_EQ(inner, 90);
}

TEST(Msdm, OfTheSameMeshIsZero)
{
    const Surface disk = load("fandisk.off");
    EXPECT_EQ(msdm(disk, disk, true), 0);
    EXPECT_LT(msdm(disk, reorder(disk, 1), false), 0.02);
}

TEST(Msdm, GrowsWithNoise)
{
    const Surface bunny = load("bunny00.off");
    double last = 0;
    for (const double amplitude : {0.0001, 0.0003, 0.001, 0.003}) { // it saturates where noise is as long as the edges
        const double now = msdm(bunny, {noise(bunny, amplitude, 1), bunny.triangles}, true);
        EXPECT_GT(now, 1.05 * last);
        last = now;
    }
    EXPECT_LT(last, 1); // beyond are curvatures that fall as the other's rise, not such as have nothing in common
}

TEST(Msdm, DoesNotMindSizeOrPosition)
{
    const Surface disk = load("fandisk.off");
    const Surface noisy = {noise(disk, 0.002, 1), disk.triangles};
    const double here = msdm(disk, noisy, true);
    // Without rotation: the longest side of the box, which sets the window, stays in proportion.
    const double there =
        msdm(shapes::moved(disk, 37, 0, {0, 0, 1}, {5, 6, 7}), shapes::moved(noisy, 37, 0, {0, 0, 1}, {5, 6, 7}), true);
    EXPECT_NEAR(here, there, 1e-3 * here);
}

TEST(Msdm, NoiseShowsMoreOnASmoothRegion)
{
    // A sphere whose northern half is rough. The same displacements, of equal MRMS, on the smooth and on
    // the rough half.
    Surface ball = shapes::sphere(5);
    Stream draws = seeded_stream(5, "roughness");
    for (Point& p : ball.points)
        if (p.z() > 0)
            p *= 1 + 0.01 * (2 * uniform(draws) - 1);
    const auto disturbed = [&](bool smooth) {
        Surface result = ball;
        Stream moves = seeded_stream(6, "moves");
        for (std::size_t v = 0; v < result.points.size(); ++v)
            if ((ball.points[v].z() < -0.1) == smooth && std::abs(ball.points[v].z()) > 0.1)
                result.points[v] *= 1 + 0.002 * (2 * uniform(moves) - 1);
        return result;
    };
    const Surface on_smooth = disturbed(true);
    const Surface on_rough = disturbed(false);
    const DistortionReport smooth = measure(ball, on_smooth);
    const DistortionReport rough = measure(ball, on_rough);
    EXPECT_NEAR(smooth.mrms, rough.mrms, 0.1 * rough.mrms);
    EXPECT_GT(*smooth.msdm, 1.2 * *rough.msdm);
}

} // namespace
