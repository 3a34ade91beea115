// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace vcg_ext {

/// What the values of one carrier tell.
enum class Statistic {
    Mean,    ///< (4.8), (5.7): the carrier's mean against 1/2
    Variance ///< (4.12), (5.11): the carrier's variance against 1/3
};

[[nodiscard]] const char* name(Statistic statistic);

/// The statistic of values that are uniform in [0, 1]: 1/2 or 1/3.
[[nodiscard]] double threshold(Statistic statistic);

/// The standard error of the statistic of `samples` values that are uniform in [0, 1].
[[nodiscard]] double standard_error(Statistic statistic, int samples);

} // namespace vcg_ext
