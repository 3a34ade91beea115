// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/payload/evidence.h"

#include "vcg_ext/base/error.h"
#include "vcg_ext/key/random.h"
#include "vcg_ext/payload/binomial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace vcg_ext;

namespace {

/// Soft values whose magnitudes spread as those of real carriers: a product of uniform numbers.
std::vector<double> drawn(int carriers, Stream& stream)
{
    std::vector<double> soft;
    for (int k = 0; k < carriers; ++k)
        soft.push_back((stream.below(2) ? 1 : -1) * uniform(stream) * (0.2 + uniform(stream)));
    return soft;
}

/// The sums of all sign patterns.
std::vector<double> all_sums(const std::vector<double>& soft)
{
    std::vector<double> sums = {0};
    for (const double l : soft) {
        const std::size_t size = sums.size();
        for (std::size_t i = 0; i < size; ++i) {
            sums.push_back(sums[i] - l);
            sums[i] += l;
        }
    }
    return sums;
}

double part_at_least(const std::vector<double>& sums, double total)
{
    double count = 0;
    for (const double sum : sums)
        count += sum >= total;
    return count / static_cast<double>(sums.size());
}

TEST(Evidence, BoundsHoldAndAreNearForAllSignPatterns)
{
    Stream stream = seeded_stream(1, "evidence-test");
    for (int carriers = 1; carriers <= 14; ++carriers) {
        const std::vector<double> soft = drawn(carriers, stream);
        const std::vector<double> sums = all_sums(soft);
        const SignTail tail(soft);
        for (std::size_t i = 0; i < sums.size(); i += 1 + sums.size() / 200) {
            if (sums[i] <= 0)
                continue;
            const double exact = part_at_least(sums, sums[i] - 1e-12);
            const double count = std::pow(10, tail.log10_count(sums[i]));
            EXPECT_GE(count, exact * (1 - 1e-9)) << carriers;
            EXPECT_LE(count, exact * 1.15 + 1e-12) << carriers;
            EXPECT_GE(std::pow(10, tail.log10_chernoff(sums[i])), exact * (1 - 1e-9)) << carriers;
        }
    }
}

TEST(Evidence, EqualMagnitudesGiveTheBinomialTail)
{
    for (const int carriers : {1, 5, 60, 64, 100, 1000}) {
        const SignTail tail(std::vector<double>(carriers, 0.3));
        for (int right = carriers / 2 + 1; right <= carriers; right += 1 + carriers / 30)
            EXPECT_NEAR(tail.log10_p(0.3 * (2 * right - carriers)), std::log10(binomial_tail(carriers, right)), 1e-9)
                << right << " of " << carriers;
    }
    EXPECT_NEAR(log_tail(std::vector<double>(1024, 2), 2048), 1024 * std::log10(0.5), 1e-9);
    const SignTail two_layers(std::vector<double>(2048, 1));
    for (const int right : {1060, 1150, 1300, 1600})
        EXPECT_NEAR(two_layers.log10_count(2 * right - 2048), std::log10(binomial_tail(2048, right)), 1e-9) << right;
}

TEST(Evidence, ChernoffNeedsNoSignsAtItsEnds)
{
    const std::vector<double> soft = {1, -2, 3};
    EXPECT_EQ(SignTail(soft).log10_chernoff(0), 0);
    EXPECT_EQ(SignTail(soft).log10_chernoff(-1), 0);
    EXPECT_NEAR(SignTail(soft).log10_chernoff(6), 3 * std::log10(0.5), 1e-6);
    // By hand: two equal carriers, total l: t where 2 tanh t = 1, p = cosh(t)^2 exp(-t).
    const double t = std::atanh(0.5);
    EXPECT_NEAR(SignTail({5, 5}).log10_chernoff(5), std::log10(std::pow(std::cosh(t), 2) * std::exp(-t)), 1e-9);
}

TEST(Evidence, BoundsAgreeWithTailsOfManyDraws)
{
    Stream stream = seeded_stream(2, "evidence-test");
    for (const int carriers : {30, 64, 128}) {
        const std::vector<double> soft = drawn(carriers, stream);
        const SignTail tail(soft);
        constexpr int draws = 20000;
        int below[4] = {};
        for (int draw = 0; draw < draws; ++draw) {
            double total = 0;
            for (const double l : soft)
                total += stream.below(2) ? l : -l;
            const double log10_p = tail.log10_count(total);
            for (int digits = 1; digits <= 3; ++digits)
                below[digits] += log10_p <= -digits;
        }
        for (int digits = 1; digits <= 3; ++digits) {
            const double nominal = draws * std::pow(10, -digits);
            EXPECT_LE(below[digits], nominal + 4 * std::sqrt(nominal)) << carriers;
            EXPECT_GE(below[digits], 0.8 * nominal - 4 * std::sqrt(nominal)) << "a weak bound at " << carriers;
        }
    }
}

TEST(Evidence, CountIsBetterThanChernoff)
{
    Stream stream = seeded_stream(3, "evidence-test");
    for (const int carriers : {64, 256, 1024}) {
        const std::vector<double> soft = drawn(carriers, stream);
        double square = 0;
        for (const double l : soft)
            square += l * l;
        const SignTail tail(soft);
        const double total = 6 * std::sqrt(square);
        EXPECT_LT(tail.log10_count(total), tail.log10_chernoff(total) - 0.5) << carriers;
        EXPECT_GT(tail.log10_count(total), tail.log10_chernoff(total) - 2) << carriers;
    }
}

TEST(Evidence, OneCarrierOutweighsAll)
{
    // The count's cells are too wide for the 40 small ones, Chernoff's bound is not.
    std::vector<double> soft(40, 1.0);
    soft.push_back(1e9);
    const double log10_p = log_tail(soft, 1e9 + 40);
    EXPECT_LT(log10_p, -10);
    EXPECT_GE(log10_p, 41 * std::log10(0.5) - 1e-9);
}

TEST(Evidence, NothingProvesNothing)
{
    EXPECT_EQ(log_tail({}, 0), 0);
    EXPECT_EQ(log_tail({0, 0, 0}, 0), 0);
    EXPECT_EQ(log_tail({0, 0, 0}, 5), 0);
    EXPECT_EQ(log_tail({1, 2}, std::nan("")), 0);
    EXPECT_EQ(log_tail({1, 2}, -3), 0);
    EXPECT_NEAR(log_tail({3}, 3), std::log10(0.5), 1e-9);
    EXPECT_NEAR(log_tail({3}, 1e9), std::log10(0.5), 1e-9); // more than all cannot be, and proves no more
}

TEST(Evidence, ScaleAndErasuresDoNotMatter)
{
    Stream stream = seeded_stream(4, "evidence-test");
    const std::vector<double> soft = drawn(50, stream);
    const double expected = log_tail(soft, 5);
    std::vector<double> erased = soft;
    erased.insert(erased.begin() + 20, {0, std::nan(""), 0});
    EXPECT_NEAR(log_tail(erased, 5), expected, 1e-6);
    for (const double scale : {1e-290, 1e290}) {
        std::vector<double> scaled = soft;
        for (double& l : scaled)
            l *= scale;
        EXPECT_NEAR(log_tail(scaled, 5 * scale), expected, 1e-9);
    }
    const double infinity = std::numeric_limits<double>::infinity();
    const std::vector<double> endless = {infinity, -infinity, infinity, 1};
    EXPECT_NEAR(log_tail(endless, agreement({1, 0, 1, 1}, endless)), 3 * std::log10(0.5), 0.31);
    EXPECT_THROW((void)agreement({1, 0}, {1}), Error);
}

TEST(Evidence, ManyMessages)
{
    EXPECT_NEAR(log_any_message(64 * std::log10(0.5), 32), 32 * std::log10(0.5), 1e-12);
    EXPECT_EQ(log_any_message(-3, 16), 0);
}

} // namespace
