// SPDX-License-Identifier: GPL-3.0-or-later
#include "carriers.h"

namespace vcg_ext {

Carriers cut_range(const std::vector<double>& scalar, double minimum, double maximum, double trim, int count)
{
    return cut_range_of(
        static_cast<int>(scalar.size()), [&scalar](int v) { return scalar[v]; }, minimum, maximum, trim, count);
}

std::vector<int> samples(const Carriers& carriers)
{
    using Counts = std::vector<int>;
    return ordered_fold(
        static_cast<int>(carriers.label.size()), Counts(carriers.count, 0),
        [&carriers](Counts& counts, int v) {
            if (carriers.label[v] >= 0)
                ++counts[carriers.label[v]];
        },
        [](Counts& counts, const Counts& part) {
            for (std::size_t k = 0; k < counts.size(); ++k)
                counts[k] += part[k];
        });
}

std::vector<double> statistics(const Carriers& carriers, Statistic statistic)
{
    struct Tally {
        double sum = 0;
        int count = 0;
    };
    using Tallies = std::vector<Tally>;
    const Tallies all = ordered_fold(
        static_cast<int>(carriers.label.size()), Tallies(carriers.count),
        [&carriers, statistic](Tallies& tallies, int v) {
            if (carriers.label[v] < 0)
                return;
            const double x = carriers.value[v];
            const double z = 2 * x - 1;
            Tally& tally = tallies[carriers.label[v]];
            tally.sum += statistic == Statistic::Mean ? x : z * z;
            ++tally.count;
        },
        [](Tallies& tallies, const Tallies& part) {
            for (std::size_t k = 0; k < tallies.size(); ++k) {
                tallies[k].sum += part[k].sum;
                tallies[k].count += part[k].count;
            }
        });
    std::vector<double> result;
    for (const Tally& tally : all)
        result.push_back(tally.count > 0 ? tally.sum / tally.count : threshold(statistic));
    return result;
}

} // namespace vcg_ext
