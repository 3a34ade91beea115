// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/carrier/demodulation.h"

#include "vcg_ext/carrier/wave_plan.h"
#include "vcg_ext/geometry/wave_values.h"
#include "vcg_ext/key/random.h"
#include "vcg_ext/payload/evidence.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

constexpr int samples = 6000;
constexpr int waves = 32;

/// Nearly normal, variance 1: of twelve uniform draws the sum.
double normal(Stream& draws)
{
    double sum = -6;
    for (int i = 0; i < 12; ++i)
        sum += uniform(draws);
    return sum;
}

/// Samples all over a sphere, each displaced by what is asked for along its normal.
struct Case {
    ResidualField field;
    Rows columns;
    WavePlan plan;
    std::vector<WaveAssumption> assumptions; ///< steps of half, once and twice the true size
    std::vector<unsigned char> bits;
};

Case make_case(std::uint64_t seed, double noise, double strength)
{
    Stream draws = seeded_stream(seed, "demodulation");
    Case result;
    result.plan = wave_plan(Key("demodulation"), waves);
    for (int i = 0; i < samples; ++i) {
        result.field.places.push_back(direction<3>(draws));
        result.field.kind.push_back(i % 3 == 0);
        result.field.roughness.push_back(uniform(draws));
    }
    const std::vector<double> values = wave_values(result.field.places, result.plan.vectors, result.plan.phases);
    result.columns = Eigen::Map<const Rows>(values.data(), samples, waves);
    for (const double size : {0.5, 1.0, 2.0}) {
        WaveAssumption one;
        one.middle.resize(waves);
        Eigen::VectorXd half(waves);
        Stream own = seeded_stream(static_cast<std::uint64_t>(size * 2), "assumption");
        for (int k = 0; k < waves; ++k) {
            one.middle[k] = size * strength * (uniform(own) - 0.5);
            half[k] = size * strength * (own.below(2) ? 1 : -1);
        }
        one.per_bit = half.asDiagonal();
        result.assumptions.push_back(one);
    }
    Eigen::VectorXd signs(waves);
    for (int k = 0; k < waves; ++k) {
        result.bits.push_back(static_cast<unsigned char>(draws.below(2)));
        signs[k] = result.bits[k] ? 1 : -1;
    }
    const WaveAssumption& truth = result.assumptions[1];
    result.field.nuisance.resize(samples, 4);
    for (int i = 0; i < samples; ++i)
        result.field.nuisance.row(i) << result.field.places[i].transpose(), 1;
    result.field.residual = result.columns * (truth.middle + truth.per_bit * signs) +
                            result.field.nuisance * Eigen::Vector4d(0.3, -0.2, 0.1, 0.05);
    for (int i = 0; i < samples; ++i)
        result.field.residual[i] += noise * normal(draws);
    result.field.floor = 1e-6;
    return result;
}

} // namespace

TEST(Demodulation, ReadsAllBitsAndTheStepWhereNoiseIsSmall)
{
    const Case given = make_case(1, 1e-3, 1e-4);
    const std::vector<Demodulated> read = demodulate(given.field, given.columns, given.plan.vectors, given.assumptions);
    EXPECT_GT(read[1].weight, 0.999);
    for (int k = 0; k < waves; ++k)
        EXPECT_EQ(read[1].soft[k] > 0, given.bits[k] != 0) << k;
}

TEST(Demodulation, InformationIsThatOfTheNormalEquations)
{
    // A wave has a mean square of 1/2, so n samples of noise s tell n (a / s)^2 / 2, times the mean weight, which by
    // Student's law is that of 4 / (3 + x^2) over normal x: 1.08.
    const Case given = make_case(2, 1e-3, 3e-5);
    const std::vector<Demodulated> read = demodulate(given.field, given.columns, given.plan.vectors, given.assumptions);
    EXPECT_NEAR(read[1].information / (samples * 0.03 * 0.03 / 2), 1.08, 0.15);
}

TEST(Demodulation, SaysNothingOfFewerSamplesThanUnknowns)
{
    const Case given = make_case(5, 1e-3, 1e-4);
    for (const int few : {0, 1, waves + 4}) {
        ResidualField field = given.field;
        field.places.resize(few);
        field.kind.resize(few);
        field.roughness.resize(few);
        field.residual.conservativeResize(few);
        field.nuisance.conservativeResize(few, Eigen::NoChange);
        const auto read = demodulate(field, given.columns.topRows(few), given.plan.vectors, given.assumptions);
        ASSERT_EQ(read.size(), given.assumptions.size());
        for (const Demodulated& one : read)
            EXPECT_EQ(one.soft, std::vector<double>(waves, 0)) << few;
    }
}

TEST(Demodulation, IsNotMovedByNuisance)
{
    Case given = make_case(3, 1e-3, 1e-4);
    const auto before = demodulate(given.field, given.columns, given.plan.vectors, given.assumptions);
    given.field.residual += given.field.nuisance * Eigen::Vector4d(-0.7, 0.2, 0.4, 0.1);
    const auto after = demodulate(given.field, given.columns, given.plan.vectors, given.assumptions);
    for (int k = 0; k < waves; ++k)
        EXPECT_NEAR(before[1].soft[k], after[1].soft[k], 0.05) << k;
}

TEST(Demodulation, OutliersHardlyCount)
{
    Case given = make_case(4, 1e-3, 1e-4);
    Stream draws = seeded_stream(4, "outliers");
    for (int i = 0; i < samples; i += 10)
        given.field.residual[i] += 0.1 * normal(draws);
    const auto read = demodulate(given.field, given.columns, given.plan.vectors, given.assumptions);
    EXPECT_GT(read[1].weight, 0.99);
    EXPECT_LT(log_tail(read[1].soft, agreement(given.bits, read[1].soft)), -6);
}

/// What all probabilities rest on: against bits that had no part in the residuals, signs are fair coins.
TEST(Demodulation, ProvesNothingWhereThereIsNoMark)
{
    int below = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        const Case given = make_case(100 + seed, 1e-3, 0);
        std::vector<WaveAssumption> assumptions = make_case(1, 1e-3, 1e-4).assumptions;
        const auto read = demodulate(given.field, given.columns, given.plan.vectors, assumptions);
        below += log_tail(read[1].soft, agreement(given.bits, read[1].soft)) < -1;
    }
    EXPECT_LE(below, 5); // of 12 in 1.2 at most on average: more than 5 once in 2,000
}
