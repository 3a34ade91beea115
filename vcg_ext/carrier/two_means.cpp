// SPDX-License-Identifier: GPL-3.0-or-later
#include "two_means.h"

#include <algorithm>
#include <numeric>

namespace vcg_ext {

double two_means(std::vector<double> values)
{
    // The sum of squares within two classes is least where that between them, n1 n2 (m1 - m2)^2 / n, is greatest.
    std::sort(values.begin(), values.end());
    const double total = std::accumulate(values.begin(), values.end(), 0.0);
    double sum = 0;
    double most = -1;
    double middle = 0;
    for (std::size_t count = 1; count < values.size(); ++count) {
        sum += values[count - 1];
        const double below = sum / static_cast<double>(count);
        const double above = (total - sum) / static_cast<double>(values.size() - count);
        const double between = static_cast<double>(count * (values.size() - count)) * (above - below) * (above - below);
        if (between > most) {
            most = between;
            middle = (below + above) / 2;
        }
    }
    return middle;
}

} // namespace vcg_ext
