// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <vector>

namespace vcg_ext {

/// The mean without the largest twentieth; 0 of nothing.
[[nodiscard]] inline double trimmed_mean(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    values.resize(values.size() * 19 / 20);
    double sum = 0;
    for (const double value : values)
        sum += value;
    return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

} // namespace vcg_ext
