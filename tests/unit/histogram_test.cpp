// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/carrier/statistic.h"
#include "vcg_ext/placement/histogram.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

std::vector<double> uniform(int count)
{
    std::vector<double> values(count);
    for (int i = 0; i < count; ++i)
        values[i] = (i + 0.5) / count;
    return values;
}

double statistic_of(const std::vector<double>& values, Statistic statistic)
{
    double sum = 0;
    for (const double x : values)
        sum += statistic == Statistic::Mean ? x : (2 * x - 1) * (2 * x - 1);
    return sum / static_cast<double>(values.size());
}

/// What tells the mapping's exponent from one value that it moved.
double exponent(double before, double after, Statistic statistic)
{
    if (statistic == Statistic::Mean)
        return std::log(after) / std::log(before);
    return std::log(std::abs(2 * after - 1)) / std::log(std::abs(2 * before - 1));
}

class Mapping : public testing::TestWithParam<Statistic> {};

TEST_P(Mapping, ReachesTheTarget)
{
    const std::vector<double> values = uniform(1000);
    for (const double target : {0.05, 0.2, 0.4, 0.43, 0.6, 0.9})
        EXPECT_NEAR(statistic_of(map_histogram(values, GetParam(), target, 0), GetParam()), target, 1e-9);
}

// For a uniform density E[x^b] = 1 / (b + 1) and E[|z|^(2b)] = 1 / (2b + 1): the exponent is known.
TEST_P(Mapping, HasTheExponentOfTheUniformDensity)
{
    const std::vector<double> values = uniform(200000);
    for (const double target : {0.25, 0.4, 0.6}) {
        const double beta = (1 / target - 1) / (GetParam() == Statistic::Mean ? 1 : 2);
        const std::vector<double> mapped = map_histogram(values, GetParam(), target, 0);
        for (const int i : {20000, 70000, 150000})
            EXPECT_NEAR(exponent(values[i], mapped[i], GetParam()), beta, 1e-4);
    }
}

TEST_P(Mapping, SparesWhatIsCostly)
{
    const std::vector<double> values = uniform(1000);
    std::vector<double> mobility(1000, 0.5);
    for (int i = 0; i < 1000; i += 2)
        mobility[i] = i % 4 == 0 ? 0 : 0.05;
    const std::vector<double> mapped = map_histogram(values, GetParam(), 0.4, 0, mobility);
    EXPECT_NEAR(statistic_of(mapped, GetParam()), 0.4, 1e-9);
    EXPECT_NEAR(mapped[300], values[300], 1e-15);
    // log beta is shared out in proportion to the mobility.
    EXPECT_NEAR(std::log(exponent(values[301], mapped[301], GetParam())),
                10 * std::log(exponent(values[302], mapped[302], GetParam())), 1e-9);
}

TEST_P(Mapping, KeepsOrderSidesAndGuard)
{
    const std::vector<double> values = uniform(500);
    constexpr double guard = 0.01;
    for (const double target : {0.02, 0.3, 0.97}) {
        const std::vector<double> mapped = map_histogram(values, GetParam(), target, guard);
        EXPECT_TRUE(std::is_sorted(mapped.begin(), mapped.end()));
        EXPECT_GE(mapped.front(), guard - 1e-15);
        EXPECT_LE(mapped.back(), 1 - guard + 1e-15);
        for (std::size_t i = 0; i < values.size() && GetParam() == Statistic::Variance; ++i) {
            EXPECT_GE((mapped[i] - 0.5) * (values[i] - 0.5), 0);
        }
    }
}

TEST_P(Mapping, OutOfReachComesAsNearAsItCan)
{
    const std::vector<double> mapped = map_histogram(uniform(100), GetParam(), 0.9999, 0.05);
    const double most = GetParam() == Statistic::Mean ? 0.95 : 0.81;
    EXPECT_NEAR(statistic_of(mapped, GetParam()), most, 1e-2);
}

TEST_P(Mapping, OneValueAndEndsOfTheCarrier)
{
    EXPECT_TRUE(map_histogram({}, GetParam(), 0.6, 0).empty());
    EXPECT_NEAR(statistic_of(map_histogram({0.3}, GetParam(), 0.6, 0), GetParam()), 0.6, 1e-9);
    for (const double x : map_histogram({0.0, 0.5, 0.25, 0.999999}, GetParam(), 0.6, 0.001))
        EXPECT_TRUE(std::isfinite(x) && x >= 0.001 - 1e-15 && x <= 0.999 + 1e-15) << x;
}

INSTANTIATE_TEST_SUITE_P(Statistics, Mapping, testing::Values(Statistic::Mean, Statistic::Variance),
                         [](const auto& info) { return std::string(name(info.param)); });

} // namespace
