// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/parallel.h"

#include <Eigen/Core>
#include <vector>

namespace vcg_ext {

/// Sum over rows of w x y^T, in pieces that do not depend on the number of threads.
template <class X, class Y>
[[nodiscard]] Eigen::MatrixXd weighted_product(const X& x, const Eigen::VectorXd& w, const Y& y)
{
    constexpr int chunk = 2048;
    const int rows = static_cast<int>(x.rows());
    std::vector<Eigen::MatrixXd> parts(chunk_count(rows, chunk));
    for_chunks(rows, chunk, [&](int begin, int end) {
        const int n = end - begin;
        parts[begin / chunk] =
            x.middleRows(begin, n).transpose() * (w.segment(begin, n).asDiagonal() * y.middleRows(begin, n));
    });
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(x.cols(), y.cols());
    for (const Eigen::MatrixXd& part : parts)
        sum += part;
    return sum;
}

} // namespace vcg_ext
