// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/carrier/comb.h"

#include "vcg_ext/carrier/carriers.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace vcg_ext;

namespace {

/// Values that crowd at some places, as norms of a shape do.
std::vector<double> lumpy(int count, unsigned seed)
{
    std::mt19937 random(seed);
    std::normal_distribution<double> near(0.6, 0.15);
    std::uniform_real_distribution<double> anywhere(0, 1);
    std::vector<double> values = {2, 3};
    while (static_cast<int>(values.size()) < count) {
        const double x = values.size() % 2 ? near(random) : std::pow(anywhere(random), 1.5);
        if (x > 0 && x < 1)
            values.push_back(2 + x);
    }
    return values;
}

/// What a mark does to them: x of every carrier becomes x^g, or x^(1 / g).
std::vector<double> combed(std::vector<double> values, double trim, int count, double g, unsigned seed)
{
    std::mt19937 random(seed);
    const Carriers carriers = cut_range(values, 2, 3, trim, count);
    std::vector<double> power(count);
    for (double& p : power)
        p = random() % 2 ? g : 1 / g;
    for (std::size_t v = 0; v < values.size(); ++v)
        if (carriers.label[v] >= 0)
            values[v] = carriers.scalar(carriers.label[v], std::pow(carriers.value[v], power[carriers.label[v]]));
    return values;
}

TEST(Comb, IsFoundWhateverItsTrim)
{
    for (unsigned seed = 0; seed < 20; ++seed) {
        const std::vector<double> plain = lumpy(8000, seed);
        EXPECT_FALSE(find_comb(plain, 2, 3).found());
        EXPECT_TRUE(find_comb(combed(plain, 0.0075 * seed, 64, 1.5, seed), 2, 3).found()) << seed;
        EXPECT_TRUE(find_comb(combed(plain, 0.0075 * seed, 128, 1.5, seed), 2, 3).found()) << seed;
    }
}

TEST(Comb, IsNotSeenInSteepHistograms)
{
    std::vector<double> steep;
    for (int i = 0; i < 100000; ++i)
        steep.push_back(std::pow(i / 100000.0, 4));
    const Comb comb = find_comb(steep, 0, 1);
    EXPECT_LT(comb.contrast, 1.4);
    EXPECT_FALSE(comb.found());
}

TEST(Comb, NeedsValues)
{
    EXPECT_FALSE(find_comb({}, 0, 1).found());
    EXPECT_FALSE(find_comb(std::vector<double>(900, 0.5), 0, 1).found());
    EXPECT_FALSE(find_comb(std::vector<double>(100000, 0.5), 0, 1).found());
    EXPECT_FALSE(find_comb(std::vector<double>(100000, NAN), 0, 1).found());
}

} // namespace
