// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../carrier/carriers.h"
#include "../carrier/statistic.h"

namespace vcg_ext {

/// Maps the values of one carrier so that their statistic reaches `target` ((4.7)-(4.14), (5.6)-(5.13); Cho et al.):
/// x' = x^beta for the mean, sign(z) |z|^beta with z = 2x - 1 for the variance.
///
/// beta is the root of a monotone function. Values end inside [guard, 1 - guard], so that rounding to float cannot push
/// one into the neighbour; where the guard keeps the target out of reach, beta is the one that comes nearest.
///
/// A value that is costly to move can be spared: its own exponent is beta^mobility, so that the others bear more.
///
/// \param values in [0, 1]
/// \param target in (0, 1)
/// \param guard in [0, 0.5)
/// \param mobility one a value, not negative, relative to each other; 0: it must not move; empty: all the same
/// \return the mapped values, in the same order
[[nodiscard]] std::vector<double> map_histogram(const std::vector<double>& values, Statistic statistic, double target,
                                                double guard, const std::vector<double>& mobility = {});

} // namespace vcg_ext
