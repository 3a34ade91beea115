// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/carrier/carriers.h"
#include "vcg_ext/carrier/statistic.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

TEST(CutRange, PutsEveryScalarInItsCarrier)
{
    // [0, 10] with a tenth trimmed at both ends: four carriers of width 2 from 1 to 9.
    const std::vector<double> scalar = {0, 0.999, 1, 2.5, 3, 8.999, 9, 10, INFINITY, -1};
    const Carriers carriers = cut_range(scalar, 0, 10, 0.1, 4);
    EXPECT_EQ(carriers.label, (std::vector<int>{-1, -1, 0, 0, 1, 3, -1, -1, -1, -1}));
    EXPECT_DOUBLE_EQ(carriers.value[3], 0.75);
    EXPECT_DOUBLE_EQ(carriers.scalar(0, 0.75), 2.5);
    EXPECT_EQ(samples(carriers), (std::vector<int>{2, 1, 0, 1}));
}

TEST(Statistics, OfAUniformCarrierAreTheThresholds)
{
    std::vector<double> scalar;
    for (int i = 0; i < 10000; ++i)
        scalar.push_back((i + 0.5) / 10000);
    const Carriers carriers = cut_range(scalar, 0, 1, 0, 1);
    EXPECT_NEAR(statistics(carriers, Statistic::Mean)[0], 1.0 / 2, 1e-8);
    EXPECT_NEAR(statistics(carriers, Statistic::Variance)[0], 1.0 / 3, 1e-8);
}

// The variance over many carriers of the statistic is the square of the standard error, here over all triples
// of a grid.
TEST(StandardError, IsTheSpreadOfTheStatistic)
{
    constexpr int grid = 40;
    for (const Statistic statistic : {Statistic::Mean, Statistic::Variance}) {
        double squares = 0;
        for (int i = 0; i < grid; ++i)
            for (int j = 0; j < grid; ++j)
                for (int k = 0; k < grid; ++k) {
                    const std::vector<double> scalar = {(i + 0.5) / grid, (j + 0.5) / grid, (k + 0.5) / grid};
                    const double off = statistics(cut_range(scalar, 0, 1, 0, 1), statistic)[0] - threshold(statistic);
                    squares += off * off;
                }
        EXPECT_NEAR(std::sqrt(squares / (grid * grid * grid)), standard_error(statistic, 3), 1e-3);
    }
}

TEST(Statistics, OfAnEmptyCarrierSayNothing)
{
    const Carriers carriers = cut_range({0.1}, 0, 1, 0, 2);
    EXPECT_EQ(statistics(carriers, Statistic::Mean)[1], threshold(Statistic::Mean));
    EXPECT_TRUE(std::isinf(standard_error(Statistic::Mean, 0)));
}

} // namespace
