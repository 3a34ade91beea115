// SPDX-License-Identifier: GPL-3.0-or-later
#include "wave_grid.h"

#include "wave_spectra.h"

#include <algorithm>
#include <cmath>

namespace vcg_ext {

namespace {

constexpr double at_rest = 0.25; ///< weight: it is read by itself too, and needs the least
constexpr double shifted = 0.5;
constexpr double undone = 0.25;

/// Shifts by u where the body is shifted by t; at rest it has a weight of its own, here 0.
WaveGrid::Row row_of_shifts(double t, double step)
{
    WaveGrid::Row row;
    row.t = t;
    const double reach = std::min(6.0, 1 + 1.5 * std::abs(t));
    const int most = static_cast<int>(reach / step + 1e-9);
    row.first = -most * step;
    for (int j = -most; j <= most; ++j) {
        const double u = j * step;
        row.log_weight.push_back(t == 0 && j == 0 ? 0 : 1 / (1 + std::pow(std::abs(t) / 1.5, 1.5)) / (1 + u * u));
    }
    return row;
}

/// A little along `bend` where smoothing by the `which`-th lambda k is undone.
WaveGrid::Row row_of_undone(int which, double lambda_k, double step)
{
    WaveGrid::Row row;
    row.undone = which;
    row.first = -2 * step;
    for (int j = -2; j <= 2; ++j)
        row.log_weight.push_back((j == 0 ? 1 : 0.25) / (1 + lambda_k));
    return row;
}

/// Makes logarithms of the weights of all rows from `first` on, which share `share`.
void take_logarithms(std::vector<WaveGrid::Row>& rows, std::size_t first, double share)
{
    double sum = 0;
    for (std::size_t i = first; i < rows.size(); ++i)
        for (const double weight : rows[i].log_weight)
            sum += weight;
    for (std::size_t i = first; i < rows.size(); ++i)
        for (double& weight : rows[i].log_weight)
            weight = std::log(weight == 0 ? at_rest : share * weight / sum);
}

WaveGrid make_grid()
{
    constexpr int levels = 160;
    WaveGrid grid;
    grid.step = 0.2;
    for (int i = -60; i <= 500; ++i)
        grid.rows.push_back(row_of_shifts(i / 10.0, grid.step));
    take_logarithms(grid.rows, 0, shifted);
    const std::size_t first = grid.rows.size();
    for (int i = 1; i <= levels; ++i) {
        grid.undone.push_back(i * WaveSpectra::nodes.back() / levels);
        grid.rows.push_back(row_of_undone(i - 1, grid.undone.back(), grid.step));
    }
    take_logarithms(grid.rows, first, undone);
    return grid;
}

} // namespace

const WaveGrid& wave_grid()
{
    static const WaveGrid grid = make_grid();
    return grid;
}

} // namespace vcg_ext
