// SPDX-License-Identifier: GPL-3.0-or-later
#include "chebyshev.h"

#include "../base/parallel.h"
#include "../base/pi.h"

#include <algorithm>
#include <cmath>

namespace vcg_ext {

double HighPass::transfer(double eigenvalue) const
{
    const double angle = std::acos(std::clamp(2 * eigenvalue / bound - 1, -1.0, 1.0));
    double sum = 0;
    for (std::size_t k = 0; k < coefficients.size(); ++k)
        sum += coefficients[k] * std::cos(k * angle);
    return sum;
}

HighPass high_pass(double cutoff, double bound, int degree)
{
    const double edge = std::acos(2 * cutoff / bound - 1);
    const double step = pi / (degree + 2);
    HighPass filter;
    filter.bound = bound;
    filter.coefficients.push_back(edge / pi);
    for (int k = 1; k <= degree; ++k) {
        const double jackson =
            ((degree + 2 - k) * std::cos(k * step) + std::sin(k * step) / std::tan(step)) / (degree + 2);
        filter.coefficients.push_back(jackson * 2 * std::sin(k * edge) / (k * pi));
    }
    return filter;
}

int high_pass_degree(double bound)
{
    return static_cast<int>(std::lround(120 * std::sqrt(bound / 24)));
}

Points apply(const HighPass& filter, const EdgeGraph& graph, const Points& x)
{
    // T_0 = x, T_1 = A x, T_(k+1) = 2 A T_k - T_(k-1), with A = 2 L / bound - 1.
    const int count = graph.vertices();
    const double scale = 2 / filter.bound;
    Points sum(count);
    Points before = x;
    Points now(count);
    for_each_index(count, [&](int v) {
        now[v] = scale * laplacian_row(graph, x, v) - x[v];
        sum[v] = filter.coefficients[0] * x[v] + filter.coefficients[1] * now[v];
    });
    for (std::size_t k = 2; k < filter.coefficients.size(); ++k) {
        for_each_index(count, [&](int v) { // T_(k-1)(v) is needed at v alone, so T_(k+1) takes its place
            before[v] = 2 * (scale * laplacian_row(graph, now, v) - now[v]) - before[v];
            sum[v] += filter.coefficients[k] * before[v];
        });
        before.swap(now);
    }
    return sum;
}

} // namespace vcg_ext
