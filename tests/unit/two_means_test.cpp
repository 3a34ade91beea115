// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/carrier/two_means.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace {

using vcg_ext::two_means;

/// Every way to part the values in two, by its definition.
double by_all_subsets(const std::vector<double>& values)
{
    double least = std::numeric_limits<double>::infinity();
    double middle = 0;
    for (unsigned subset = 1; subset + 1 < 1u << values.size(); ++subset) {
        double mean[2] = {0, 0};
        int count[2] = {0, 0};
        for (std::size_t i = 0; i < values.size(); ++i) {
            mean[subset >> i & 1] += values[i];
            ++count[subset >> i & 1];
        }
        mean[0] /= count[0];
        mean[1] /= count[1];
        double spread = 0;
        for (std::size_t i = 0; i < values.size(); ++i)
            spread += std::pow(values[i] - mean[subset >> i & 1], 2);
        if (spread < least) {
            least = spread;
            middle = (mean[0] + mean[1]) / 2;
        }
    }
    return middle;
}

TEST(TwoMeans, IsTheBestOfAllPartitions)
{
    std::vector<double> values;
    for (int i = 0; i < 12; ++i) {
        values.push_back(std::fmod(i * 0.754877666, 1) + (i % 3 == 0 ? 0.7 : 0));
        if (values.size() < 2)
            continue;
        EXPECT_NEAR(two_means(values), by_all_subsets(values), 1e-12);
    }
}

TEST(TwoMeans, EqualValuesAreTheirOwnThreshold)
{
    EXPECT_EQ(two_means({2, 2, 2}), 2);
}

} // namespace
