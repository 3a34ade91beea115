// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/base/weld.h"
#include "vcg_ext/geometry/laplacian.h"

#include "support/load.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace {

using namespace vcg_ext;

/// (3.12) from its definition, by another way than the library's: entry by entry from the faces.
Eigen::MatrixXd dense_laplacian(const Surface& surface)
{
    const auto n = static_cast<Eigen::Index>(surface.points.size());
    Eigen::MatrixXd l = Eigen::MatrixXd::Zero(n, n);
    for (const Triangle& t : surface.triangles)
        for (int k = 0; k < 3; ++k)
            l(t[k], t[(k + 1) % 3]) = l(t[(k + 1) % 3], t[k]) = -1;
    for (Eigen::Index i = 0; i < n; ++i)
        l(i, i) = -l.row(i).sum();
    return l;
}

TEST(Laplacian, EqualsItsDefinition)
{
    const Surface surface = weld(load("anchor.off")).surface;
    const EdgeGraph graph = edge_graph(surface);
    const Eigen::MatrixXd expected = dense_laplacian(surface);
    Eigen::MatrixX3d x(surface.points.size(), 3);
    for (std::size_t v = 0; v < surface.points.size(); ++v)
        x.row(static_cast<Eigen::Index>(v)) = surface.points[v];
    const Eigen::MatrixX3d product = expected * x;
    for (int v = 0; v < graph.vertices(); ++v) {
        EXPECT_EQ(graph.degree(v), expected(v, v));
        EXPECT_LT((laplacian_row(graph, surface.points, v) - Point(product.row(v))).norm(), 1e-12 * x.norm());
    }
}

TEST(Laplacian, TheBoundHolds)
{
    const Surface tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                              {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    EXPECT_EQ(laplacian_bound(edge_graph(tetrahedron)), 6); // K4: its eigenvalues are 0, 4, 4, 4
    const Surface anchor = weld(load("anchor.off")).surface;
    const double largest =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense_laplacian(anchor), Eigen::EigenvaluesOnly)
            .eigenvalues()
            .maxCoeff();
    EXPECT_GE(laplacian_bound(edge_graph(anchor)), largest);
}

} // namespace
