// SPDX-License-Identifier: GPL-3.0-or-later
#include "sample_weights.h"

#include "../base/median.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace vcg_ext {

namespace {

constexpr double nu = 3;             ///< degrees of freedom of the noise
constexpr double cell = 0.15;        ///< side of the cells in which the noise has one spread
constexpr double pseudo_samples = 8; ///< of the kind's spread, in each cell
constexpr double kind_share = 0.25;  ///< of the kind's variance, added in each cell
constexpr double outlier = 36;       ///< squared errors count up to so many times the kind's variance
constexpr int bins = 16;             ///< of roughness

/// Places of equal key get equal numbers.
template <class Key>
std::vector<int> numbered(const std::vector<Key>& keys)
{
    std::vector<Key> sorted = keys;
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    std::vector<int> numbers;
    numbers.reserve(keys.size());
    for (const Key& key : keys)
        numbers.push_back(static_cast<int>(std::lower_bound(sorted.begin(), sorted.end(), key) - sorted.begin()));
    return numbers;
}

/// The variance around each sample: that of its cell, shrunk to the kind's, times what its roughness adds.
std::vector<double> local_variances(const SampleGroup& group, const std::vector<double>& sizes, double variance)
{
    const std::size_t n = sizes.size();
    const auto squared = [&](std::size_t m) { return std::min(sizes[m] * sizes[m], outlier * variance); };
    const int cells = 1 + *std::max_element(group.cells.begin(), group.cells.end());
    std::vector<double> in_cell(cells, pseudo_samples * variance);
    std::vector<double> held(cells, pseudo_samples);
    for (std::size_t m = 0; m < n; ++m) {
        in_cell[group.cells[m]] += squared(m);
        held[group.cells[m]] += 1;
    }
    std::vector<double> local(n);
    for (std::size_t m = 0; m < n; ++m)
        local[m] = in_cell[group.cells[m]] / held[group.cells[m]] + kind_share * variance;
    if (n > 400) {
        std::array<double, bins> ratio{};
        std::array<double, bins> count{};
        for (std::size_t m = 0; m < n; ++m) {
            ratio[group.bins[m]] += squared(m) / local[m];
            count[group.bins[m]] += 1;
        }
        for (std::size_t m = 0; m < n; ++m)
            local[m] *= std::clamp(ratio[group.bins[m]] / std::max(count[group.bins[m]], 1.0) + 0.02, 0.02, 50.0);
    }
    return local;
}

} // namespace

SampleGroup group_of(const ResidualField& field, int kind)
{
    SampleGroup group;
    std::vector<std::array<int, 3>> cells;
    std::vector<std::pair<double, int>> order;
    for (int i = 0; i < field.count(); ++i) {
        if (field.kind[i] != kind)
            continue;
        const Point& p = field.places[i];
        cells.push_back({static_cast<int>(std::floor(p[0] / cell)), static_cast<int>(std::floor(p[1] / cell)),
                         static_cast<int>(std::floor(p[2] / cell))});
        order.emplace_back(field.roughness[i], static_cast<int>(group.members.size()));
        group.members.push_back(i);
    }
    group.cells = numbered(cells);
    std::sort(order.begin(), order.end());
    group.bins.resize(order.size());
    for (std::size_t rank = 0; rank < order.size(); ++rank)
        group.bins[order[rank].second] = static_cast<int>(rank * bins / order.size());
    return group;
}

void weigh(const SampleGroup& group, const Eigen::VectorXd& error, double floor, Eigen::VectorXd& weights)
{
    const std::size_t n = group.members.size();
    std::vector<double> sizes;
    for (const int i : group.members)
        sizes.push_back(std::abs(error[i]));
    const double middle = median(sizes);
    double variance = floor;
    for (const double size : sizes)
        variance += std::min(size * size, outlier * 2.2 * middle * middle) / static_cast<double>(n);
    const std::vector<double> local = local_variances(group, sizes, variance);
    for (std::size_t m = 0; m < n; ++m) {
        const double v = local[m] + floor;
        weights[group.members[m]] = (nu + 1) / (nu + sizes[m] * sizes[m] / v) / v / group.inflation;
    }
}

} // namespace vcg_ext
