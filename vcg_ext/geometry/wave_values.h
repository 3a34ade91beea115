// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// Per point the sum over waves of `amplitudes[k]` cos(waves[k] . x + phases[k]).
[[nodiscard]] std::vector<double> sums_of_waves(const Points& points, const Points& waves,
                                                const std::vector<double>& phases,
                                                const std::vector<double>& amplitudes);

/// cos(waves[k] . x + phases[k]): row after row, one row a point.
[[nodiscard]] std::vector<double> wave_values(const Points& points, const Points& waves,
                                              const std::vector<double>& phases);

} // namespace vcg_ext
