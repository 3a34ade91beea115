// SPDX-License-Identifier: GPL-3.0-or-later
#include "eigenbasis.h"

#include "../base/error.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>

namespace vcg_ext {

namespace {

Eigen::MatrixXd patch_laplacian(const EdgeGraph& graph, const std::vector<int>& vertices)
{
    const int count = static_cast<int>(vertices.size());
    Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(count, count);
    for (int i = 0; i < count; ++i)
        for (const int* w = graph.begin(vertices[i]); w != graph.end(vertices[i]); ++w) {
            const auto found = std::lower_bound(vertices.begin(), vertices.end(), *w);
            if (found == vertices.end() || *found != *w)
                continue;
            laplacian(i, found - vertices.begin()) = -1;
            laplacian(i, i) += 1;
        }
    return laplacian;
}

} // namespace

Points exact_high_band(const EdgeGraph& graph, const Points& x, const std::vector<int>& vertices, double share)
{
    constexpr int most = 2500;
    const int count = static_cast<int>(vertices.size());
    if (count > most)
        throw Error("A patch has " + std::to_string(count) + " vertices, too many for an exact eigenbasis (" +
                    std::to_string(most) + "). Set more bits, or leave chapter 3 as printed.");
    if (count == 0)
        return {};
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(patch_laplacian(graph, vertices));
    const auto high = solver.eigenvectors().rightCols(std::lround(share * count));
    Eigen::MatrixX3d positions(count, 3);
    for (int i = 0; i < count; ++i)
        positions.row(i) = x[vertices[i]];
    const Eigen::MatrixX3d band = high * (high.transpose() * positions);
    Points result(count);
    for (int i = 0; i < count; ++i)
        result[i] = band.row(i);
    return result;
}

} // namespace vcg_ext
