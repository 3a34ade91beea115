// SPDX-License-Identifier: GPL-3.0-or-later
#include "statistic.h"

#include <cmath>

namespace vcg_ext {

const char* name(Statistic statistic)
{
    return statistic == Statistic::Mean ? "Mean" : "Variance";
}

double threshold(Statistic statistic)
{
    return statistic == Statistic::Mean ? 1.0 / 2 : 1.0 / 3;
}

double standard_error(Statistic statistic, int samples)
{
    // Var x = 1/12, Var (2x - 1)^2 = 1/5 - 1/9.
    const double variance = statistic == Statistic::Mean ? 1.0 / 12 : 4.0 / 45;
    return samples > 0 ? std::sqrt(variance / samples) : INFINITY;
}

} // namespace vcg_ext
