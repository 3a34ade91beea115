// SPDX-License-Identifier: GPL-3.0-or-later
#include "carriers.h"

#include "../base/parallel.h"

namespace vcg_ext {

Carriers cut_range(const std::vector<double>& scalar, double minimum, double maximum, double trim, int count)
{
    Carriers carriers;
    carriers.count = count;
    carriers.low = minimum + trim * (maximum - minimum);
    carriers.width = (1 - 2 * trim) * (maximum - minimum) / count;
    carriers.label.assign(scalar.size(), -1);
    carriers.value.assign(scalar.size(), 0);
    for_each_index(static_cast<int>(scalar.size()), [&](int v) {
        const double place = (scalar[v] - carriers.low) / carriers.width;
        if (!(scalar[v] >= 0 && place >= 0 && place < count))
            return;
        carriers.label[v] = static_cast<int>(place);
        carriers.value[v] = place - carriers.label[v];
    });
    return carriers;
}

std::vector<int> samples(const Carriers& carriers)
{
    std::vector<int> count(carriers.count, 0);
    for (const int label : carriers.label)
        if (label >= 0)
            ++count[label];
    return count;
}

std::vector<double> statistics(const Carriers& carriers, Statistic statistic)
{
    std::vector<double> sum(carriers.count, 0);
    std::vector<int> count(carriers.count, 0);
    for (std::size_t v = 0; v < carriers.label.size(); ++v) {
        const int label = carriers.label[v];
        if (label < 0)
            continue;
        const double x = carriers.value[v];
        const double z = 2 * x - 1;
        sum[label] += statistic == Statistic::Mean ? x : z * z;
        ++count[label];
    }
    for (int k = 0; k < carriers.count; ++k)
        sum[k] = count[k] > 0 ? sum[k] / count[k] : threshold(statistic);
    return sum;
}

} // namespace vcg_ext
