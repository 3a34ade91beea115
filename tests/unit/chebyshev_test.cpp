// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/base/weld.h"
#include "vcg_ext/geometry/chebyshev.h"

#include "support/load.h"
#include "support/shapes.h"
#include "vcg_ext/base/parallel.h"
#include "vcg_ext/carrier/patches.h"
#include "vcg_ext/geometry/rings.h"
#include "vcg_ext/method/patch_reading.h"
#include "vcg_ext/method/spectral.h"
#include "vcg_ext/watermark/secrets.h"
#include "vcg_ext/watermark/watermark.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace {

using namespace vcg_ext;

constexpr double cutoff = 2; // as the spectral method has it

/// A whole mesh of 1,556 vertices with its exact eigenbasis.
struct Exact {
    Surface surface = weld(load("ellipe0.003.off")).surface;
    EdgeGraph graph = edge_graph(surface);
    Eigen::VectorXd eigenvalues;
    Eigen::MatrixXd basis;

    Exact()
    {
        const int n = graph.vertices();
        Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(n, n);
        for (int v = 0; v < n; ++v) {
            laplacian(v, v) = graph.degree(v);
            for (const int* w = graph.begin(v); w != graph.end(v); ++w)
                laplacian(v, *w) = -1;
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(laplacian);
        eigenvalues = solver.eigenvalues();
        basis = solver.eigenvectors();
    }

    /// The sum over the eigenvectors, each times `gain` of its eigenvalue.
    template <class Gain>
    [[nodiscard]] Points filtered(const Points& x, const Gain& gain) const
    {
        Eigen::MatrixX3d rows(x.size(), 3);
        for (std::size_t v = 0; v < x.size(); ++v)
            rows.row(static_cast<Eigen::Index>(v)) = x[v];
        Eigen::MatrixX3d coefficients = basis.transpose() * rows;
        for (Eigen::Index k = 0; k < coefficients.rows(); ++k)
            coefficients.row(k) *= gain(eigenvalues[k]);
        rows = basis * coefficients;
        Points result(x.size());
        for (std::size_t v = 0; v < x.size(); ++v)
            result[v] = rows.row(static_cast<Eigen::Index>(v));
        return result;
    }
};

const Exact& exact()
{
    static const Exact instance;
    return instance;
}

Points centred(const Surface& surface)
{
    const Point centre = principal_frame(surface).centre;
    Points points = surface.points;
    for (Point& p : points)
        p -= centre;
    return points;
}

HighPass usual_filter(const EdgeGraph& graph)
{
    const double bound = laplacian_bound(graph);
    return high_pass(cutoff, bound, high_pass_degree(bound));
}

TEST(Chebyshev, IsAStepButForTheStatedTransition)
{
    for (const double bound : {14.0, 18.0, 24.0, 40.0, 100.0}) {
        const HighPass filter = high_pass(cutoff, bound, high_pass_degree(bound));
        for (double lambda = 0; lambda <= bound; lambda += bound / 5000) {
            const double gain = filter.transfer(lambda);
            EXPECT_GE(gain, -1e-12);
            EXPECT_LE(gain, 1 + 1e-12);
            if (lambda < 1.5) {
                EXPECT_LT(gain, 0.02) << bound << " " << lambda;
            } else if (lambda > 2.5) {
                EXPECT_GT(gain, 0.98) << bound << " " << lambda;
            }
        }
    }
}

TEST(Chebyshev, ProductsEqualTheExactEigenbasis)
{
    const HighPass filter = usual_filter(exact().graph);
    const Points x = centred(exact().surface);
    const Points products = apply(filter, exact().graph, x);
    const Points sums = exact().filtered(x, [&](double lambda) { return filter.transfer(lambda); });
    for (std::size_t v = 0; v < x.size(); ++v)
        EXPECT_LT((products[v] - sums[v]).norm(), 1e-10 * bounding_diagonal(exact().surface));
}

TEST(Chebyshev, IsTheSameAtAnyNumberOfThreads)
{
    const Surface surface = weld(load("fandisk.off")).surface;
    const EdgeGraph graph = edge_graph(surface);
    set_threads(1);
    const Points one = apply(usual_filter(graph), graph, surface.points);
    set_threads(5);
    const Points five = apply(usual_filter(graph), graph, surface.points);
    set_threads(0);
    EXPECT_EQ(one, five);
}

/// The series term by term, as it is written.
Points plainly(const HighPass& filter, const EdgeGraph& graph, const Points& x)
{
    const auto product = [&](const Points& y) {
        Points result(y.size());
        for (int v = 0; v < graph.vertices(); ++v)
            result[v] = 2 / filter.bound * laplacian_row(graph, y, v) - y[v];
        return result;
    };
    Points before = x;
    Points now = product(x);
    Points sum(x.size());
    for (std::size_t v = 0; v < x.size(); ++v)
        sum[v] = filter.coefficients[0] * x[v] + filter.coefficients[1] * now[v];
    for (std::size_t k = 2; k < filter.coefficients.size(); ++k) {
        const Points twice = product(now);
        for (std::size_t v = 0; v < x.size(); ++v) {
            before[v] = 2 * twice[v] - before[v];
            sum[v] += filter.coefficients[k] * before[v];
        }
        before.swap(now);
    }
    return sum;
}

/// Long enough for many stretches of blocks, which the terms are taken over at a time.
Surface strip()
{
    Body body = body_of(shapes::triangular_grid(6, 0.06, 0.002));
    number_by_rings(body);
    return body.surface;
}

TEST(Chebyshev, SeveralTermsAtATimeAreTheSeries)
{
    const Surface surface = strip();
    const EdgeGraph graph = edge_graph(surface);
    for (const int degree : {1, 2, 21, 24}) {
        const HighPass filter = high_pass(cutoff, laplacian_bound(graph), degree);
        set_threads(3);
        const Points blocked = apply(filter, graph, surface.points);
        set_threads(1);
        EXPECT_EQ(apply(filter, graph, surface.points), blocked);
        set_threads(0);
        const Points plain = plainly(filter, graph, surface.points);
        for (std::size_t v = 0; v < plain.size(); ++v)
            ASSERT_LT((blocked[v] - plain[v]).norm(), 1e-12) << degree;
    }
}

TEST(Chebyshev, TheBandOfAFewMovesIsThatOfAll)
{
    const Surface surface = strip();
    const EdgeGraph graph = edge_graph(surface);
    const HighPass filter = high_pass(cutoff, laplacian_bound(graph), 24);
    const std::vector<int> moved = {5, 700, 701, 40000};
    Points all(surface.points.size(), Point::Zero());
    Points moves;
    for (const int v : moved) {
        moves.emplace_back(surface.points[v] - Point(1, 2, 3));
        all[v] = moves.back();
    }
    Points band(all.size(), Point::Zero());
    add_band_of_moves(filter, graph, moved, moves, band);
    const Points expected = apply(filter, graph, all);
    for (std::size_t v = 0; v < all.size(); ++v)
        ASSERT_LT((band[v] - expected[v]).norm(), 1e-14);
}

TEST(Chebyshev, MarkedPatchesHaveTheShapesOfTheExactProjector)
{
    const Key key("exact");
    Surface marked = exact().surface;
    EmbedOptions options;
    options.carriers.method = Method::Spectral;
    options.carriers.bits = 16;
    // What the patches hold is given, whatever the mask is.
    options.message = read_message("bits:1100000011011110");
    Stream draws = key.stream("bit-mask");
    for (std::uint8_t& bit : options.message.bits)
        bit ^= static_cast<std::uint8_t>(draws.below(2));
    options.message.bits = masked(options.message.bits, bit_mask(key, "patches", options.carriers.bits));
    (void)embed(marked, key, options);

    const PatchReading read = read_patches(marked, plan_spectral(key, options.carriers), principal_frame(marked));
    const Points projected =
        exact().filtered(centred(marked), [](double lambda) { return lambda > cutoff ? 1.0 : 0.0; });
    std::vector<double> errors;
    for (int k = 0; k < read.patches.count(); ++k) {
        const double ratio = patch_shape(projected, read.vertices[k]).ratio();
        errors.push_back(std::abs(read.shapes[k].ratio() / ratio - 1));
        EXPECT_EQ(std::log(ratio) > read.threshold, read.soft(k) > 0) << k;
    }
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() / 2], 0.05);
}

} // namespace
