// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/base/weld.h"
#include "vcg_ext/geometry/laplacian.h"
#include "vcg_ext/geometry/umbrella.h"

#include "support/load.h"

#include <cmath>
#include <gtest/gtest.h>

namespace {

using namespace vcg_ext;

/// On an octahedron each vertex has the four others but its opposite as neighbours. So a coordinate is an eigenfunction
/// of "value less neighbours' mean" to 1, and a constant to 0.
TEST(Taubin, ScalesEigenfunctionsByItsTransferFunction)
{
    const Surface octahedron{{{3, 5, 5}, {7, 5, 5}, {5, 3, 5}, {5, 7, 5}, {5, 5, 3}, {5, 5, 7}},
                             {{1, 3, 5}, {3, 0, 5}, {0, 2, 5}, {2, 1, 5}, {3, 1, 4}, {0, 3, 4}, {2, 0, 4}, {1, 2, 4}}};
    const EdgeGraph graph = edge_graph(octahedron);
    const Point centre(5, 5, 5);
    for (const int passes : {0, 1, 3}) {
        const Points got = taubin(graph, octahedron.points, passes);
        const double gain = std::pow((1 - 0.5) * (1 + 0.53), passes);
        for (std::size_t v = 0; v < got.size(); ++v)
            EXPECT_LT((got[v] - centre - gain * (octahedron.points[v] - centre)).norm(), 1e-12);
    }
}

TEST(Umbrella, SeveralSideBySideAreEachAsItIsAlone)
{
    const Surface bunny = weld(load("bunny00.off")).surface;
    const EdgeGraph graph = edge_graph(bunny);
    constexpr int count = 4;
    std::vector<Eigen::Matrix<double, 3, count>> all(bunny.points.size());
    std::vector<Points> alone(count, bunny.points);
    for (std::size_t v = 0; v < all.size(); ++v)
        for (int k = 0; k < count; ++k)
            all[v].col(k) = alone[k][v] = bunny.points[v] * std::cos(k * static_cast<double>(v));
    all = umbrella_steps(graph, std::move(all), 0.5, 3);
    for (int k = 0; k < count; ++k) {
        for (int step = 0; step < 3; ++step)
            alone[k] = umbrella_step(graph, alone[k], 0.5);
        for (std::size_t v = 0; v < all.size(); ++v)
            ASSERT_EQ(all[v].col(k), alone[k][v]);
    }
}

TEST(Taubin, SmoothsWithoutShrinking)
{
    const Surface bunny = weld(load("bunny00.off")).surface;
    const EdgeGraph graph = edge_graph(bunny);
    const Points smooth = taubin(graph, bunny.points, 10);
    const auto roughness = [&](const Points& x) {
        double sum = 0;
        for (int v = 0; v < graph.vertices(); ++v)
            sum += laplacian_row(graph, x, v).squaredNorm();
        return std::sqrt(sum);
    };
    EXPECT_LT(roughness(smooth), roughness(bunny.points) / 2);
    EXPECT_NEAR(bounding_diagonal({smooth, bunny.triangles}) / bounding_diagonal(bunny), 1, 0.01);
}

} // namespace
