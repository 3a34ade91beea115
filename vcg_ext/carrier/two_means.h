// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

namespace vcg_ext {

/// The middle between the means of the two classes that part `values` with the least sum of squares within them:
/// of all cuts of the sorted values the best, so the result does not hang on a start. It never looks at what a
/// value stands for.
///
/// \param values at least two
[[nodiscard]] double two_means(std::vector<double> values);

} // namespace vcg_ext
