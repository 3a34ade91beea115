// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

namespace vcg_ext {

/// Which shifts (t, u) a reading tries, and their weights, which sum to 1: fixed before looking.
///
/// A quarter of the weight is for the body as it is. Half is for shifts by t along the `bend` of a WaveView and by u
/// along its `relax`. The last is for smoothing with uniform weights, (1 + lambda L)^k: it is undone for products
/// lambda k of a given list by six terms of the binomial series of (1 + lambda L)^-k, lambda = 1/2; there `t` shifts a
/// little along `bend`.
struct WaveGrid {
    struct Row {
        int undone = -1; ///< which phases it starts from: `undone[i]`, or -1 for `phase`
        double t = 0;    ///< of the whole row, at rest
        double first = 0;
        std::vector<double> log_weight; ///< of u (t where undone) = first, first + step, ...
    };
    double step = 0;
    std::vector<double> undone; ///< lambda k
    std::vector<Row> rows;
};

[[nodiscard]] const WaveGrid& wave_grid();

} // namespace vcg_ext
