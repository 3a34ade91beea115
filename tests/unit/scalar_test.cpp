// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/method/scalar.h"

#include "vcg_ext/carrier/statistic.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

Plan plan_of(int carriers)
{
    Plan plan;
    plan.options.bits = carriers;
    plan.options.statistic = Statistic::Mean;
    for (int k = 0; k < carriers; ++k)
        plan.order.push_back(k);
    return plan;
}

TEST(ReadPart, TakesOffWhatTheOriginalsPartDiffersByFromItsWhole)
{
    // One carrier whose whole reads .4, in halves of .3 and .5; the mark adds .15, and the first half is cut off.
    const Carriers original = {1, 0, 1, {0, 0, 0, 0}, {0.3, 0.3, 0.5, 0.5}};
    const Carriers part = {1, 0, 1, {0, 0}, {0.65, 0.65}};
    const Reading read = read_part(part, original, {0, 0, 1, 1}, plan_of(1)).ways.front();
    EXPECT_NEAR(read.soft[0], (0.4 + 0.15 - 0.5) / standard_error(Statistic::Mean, 2), 1e-12);
    EXPECT_EQ(read.samples[0], 2);
}

TEST(ReadPart, OfTheWholeIsWhatReadingItSays)
{
    const Carriers original = {2, 0, 0.5, {0, 1, 0, 1}, {0.3, 0.6, 0.5, 0.1}};
    const Carriers marked = {2, 0, 0.5, {0, 1, 0, 1}, {0.5, 0.4, 0.7, 0.2}};
    const Reading part = read_part(marked, original, {1, 1, 1, 1}, plan_of(2)).ways.front();
    const Reading whole = read_carriers(marked, plan_of(2)).ways.front();
    for (int k = 0; k < 2; ++k)
        EXPECT_NEAR(part.soft[k], whole.soft[k], 1e-12);
}

TEST(ReadPart, WhereNothingOfTheOriginalIsLeftIsAnErasure)
{
    const Carriers original = {2, 0, 0.5, {0, 1}, {0.3, 0.6}};
    const Reading read = read_part({2, 0, 0.5, {0, 1}, {0.4, 0.6}}, original, {1, 0}, plan_of(2)).ways.front();
    EXPECT_NE(read.soft[0], 0);
    EXPECT_EQ(read.soft[1], 0);
}

TEST(TargetScalars, AreTheSameStepByStepAndAtOnce)
{
    const Carriers cover = {3, 0, 1, {0, 0, 1, 2, 1, -1, 2, 0}, {0.3, 0.6, 0.5, 0.4, 0.1, 0, 0.7, 0.2}};
    const std::vector<double> mobility(8, 1);
    const std::vector<char> bits = {1, 0, 1};
    TargetScalars steps(cover, mobility, bits, Statistic::Mean, 1e-6);
    (void)steps.at({0.6, 0.45, 0.5});
    for (const std::vector<double>& targets : {std::vector<double>{0.6, 0.45, 0.6}, {0.7, 0.2, 0.6}}) {
        const std::vector<double> once = TargetScalars(cover, mobility, bits, Statistic::Mean, 1e-6).at(targets);
        const std::vector<double>& step = steps.at(targets);
        for (std::size_t v = 0; v < once.size(); ++v)
            EXPECT_TRUE(once[v] == step[v] || (std::isnan(once[v]) && std::isnan(step[v]))) << v;
        EXPECT_NEAR((once[0] + once[1] + once[7]) / 3, targets[0], 1e-9);
        EXPECT_TRUE(std::isnan(once[5]));
    }
}

TEST(CarrierTargets, LieOnTheSideOfTheBitThatThePlanGivesThem)
{
    Plan plan = plan_of(2);
    plan.order = {1, 0}; // carrier 1 holds the first bit
    const CarrierTargets targets({1, 0}, plan, 0.2);
    EXPECT_EQ(targets.now(), (std::vector<double>{0.5 - 0.2, 0.5 + 0.2}));
    // A mean of .3 is right by all of alpha, and one of .4 wrong by half of it; three quarters of it are enough.
    const std::vector<double> margins = targets.margins({2, 0, 0.5, {0, 1}, {0.3, 0.4}});
    EXPECT_NEAR(margins[0], 0.2 - 0.15, 1e-12);
    EXPECT_NEAR(margins[1], -0.1 - 0.15, 1e-12);
    EXPECT_EQ(targets.wrong(margins), 1);
}

TEST(CarrierTargets, APushThatBroughtHalfIsFollowedByOneTwiceAsFarAsWhatIsMissing)
{
    CarrierTargets targets({1, 1}, plan_of(2), 0.1);
    targets.push({-0.03, 0.01});
    EXPECT_NEAR(targets.now()[0], 0.6 + 0.055, 1e-12); // up to alpha: the quarter beyond what is enough, too
    EXPECT_EQ(targets.now()[1], 0.6);
    targets.push({-0.03 + 0.055 / 2, 0.01});
    EXPECT_NEAR(targets.now()[0], 0.655 + 2 * 0.0275, 1e-12);
    EXPECT_EQ(targets.now()[1], 0.6);
}

} // namespace
