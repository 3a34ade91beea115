// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <cmath>

namespace vcg_ext {

constexpr double log10_2 = 0.301029995663981195;

/// A soft value as all that follows takes it: what is not a number is an erasure, and 1e300 is the most, so that the sum
/// of 1024 is no infinity.
[[nodiscard]] inline double usable(double soft)
{
    constexpr double most = 1e300;
    return std::isnan(soft) ? 0 : std::clamp(soft, -most, most);
}

} // namespace vcg_ext
