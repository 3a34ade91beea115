// SPDX-License-Identifier: GPL-3.0-or-later
#include "demodulation.h"

#include "../base/median.h"
#include "../key/random.h"
#include "noise_inflation.h"
#include "sample_weights.h"
#include "weighted_product.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

namespace vcg_ext {

namespace {

constexpr int rough_samples = 8000; ///< for all but the last steps
constexpr int most_steps = 8;
constexpr double most_soft = 6;

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The normal equations with the nuisance taken out: the rest depends on the assumption by small matrices alone.
struct Reduced {
    Eigen::LDLT<MatrixXd> nuisance;
    MatrixXd cross;   ///< nuisance times waves
    VectorXd answer;  ///< nuisance times residual
    MatrixXd waves;   ///< waves times waves, less what the nuisance explains
    VectorXd seen;    ///< waves times residual, likewise
    double power = 0; ///< of the residual, likewise
};

Reduced reduced(const Rows& nuisance, const Rows& waves, const VectorXd& residual, const VectorXd& weights)
{
    Reduced result;
    MatrixXd own = weighted_product(nuisance, weights, nuisance);
    own.diagonal().array() += 1e-9 * own.trace();
    result.nuisance.compute(own);
    result.cross = weighted_product(nuisance, weights, waves);
    result.answer = weighted_product(nuisance, weights, residual);
    const MatrixXd solved = result.nuisance.solve(result.cross);
    const VectorXd fitted = result.nuisance.solve(result.answer);
    result.waves = weighted_product(waves, weights, waves) - result.cross.transpose() * solved;
    result.seen = weighted_product(waves, weights, residual) - result.cross.transpose() * fitted;
    result.power = residual.cwiseAbs2().dot(weights) - result.answer.dot(fitted);
    return result;
}

/// What one assumption makes of the reduced equations.
struct Solution {
    VectorXd bits; ///< posterior means
    VectorXd shrinkage;
    double log_evidence = 0;
    double information = 0;
};

/// What a bit's evidence gains where c is not N(0, 1), but -1 or 1: that is what tells steps apart. Seen by itself, the
/// bit is c + N(0, (1 - mu) / mu), and its posterior mean under N(0, 1) is mu times that.
double for_two_points(double mean, double shrinkage)
{
    const double seen = mean / shrinkage;
    const double variance = (1 - shrinkage) / shrinkage;
    const double near = std::abs(seen) - 1;
    const double two_points = -near * near / (2 * variance) - std::log(variance) / 2 +
                              std::log1p(std::exp(-2 * std::abs(seen) / variance)) - std::log(2.0);
    return two_points + seen * seen / (2 * (1 + variance)) + std::log(1 + variance) / 2;
}

/// \param inflation of the noise, per bit
Solution solution_of(const Reduced& equations, const WaveAssumption& assumption, const VectorXd& inflation)
{
    const VectorXd scale = inflation.cwiseSqrt().cwiseInverse();
    const MatrixXd seen = scale.asDiagonal() * (assumption.per_bit.transpose() * equations.waves * assumption.per_bit) *
                          scale.asDiagonal();
    const VectorXd right =
        inflation.cwiseInverse().asDiagonal() *
        (assumption.per_bit.transpose() * (equations.seen - equations.waves * assumption.middle)).eval();
    const auto count = seen.rows();
    const Eigen::LLT<MatrixXd> solver(seen + MatrixXd::Identity(count, count));
    Solution result;
    result.bits = solver.solve(right);
    result.shrinkage = solver.solve(seen).diagonal().cwiseMax(1e-9).cwiseMin(1 - 1e-9);
    result.information = seen.trace() / static_cast<double>(count);
    const double middle = equations.power - 2 * equations.seen.dot(assumption.middle) +
                          assumption.middle.dot(equations.waves * assumption.middle);
    const VectorXd diagonal = MatrixXd(solver.matrixL()).diagonal();
    result.log_evidence = assumption.log_prior + right.dot(result.bits) / 2 - diagonal.array().log().sum() -
                          middle / inflation.mean() / 2;
    for (Eigen::Index k = 0; k < count; ++k)
        result.log_evidence += for_two_points(result.bits[k], result.shrinkage[k]);
    return result;
}

/// The rows of some samples.
template <class M>
M taken(const M& all, const std::vector<int>& some)
{
    M result(static_cast<Eigen::Index>(some.size()), all.cols());
    for (std::size_t i = 0; i < some.size(); ++i)
        result.row(static_cast<Eigen::Index>(i)) = all.row(some[i]);
    return result;
}

/// The weights, and what they come to; goes on where it was left.
class Fit {
public:
    Fit(const ResidualField& field, const Rows& waves, const std::vector<WaveAssumption>& assumptions)
        : field_(field), waves_(waves), assumptions_(assumptions), decoys_(field.places),
          inflation_(VectorXd::Ones(waves.cols()))
    {
        for (const int kind : {0, 1}) {
            SampleGroup group = group_of(field, kind);
            if (!group.members.empty())
                groups_.push_back(std::move(group));
        }
        std::vector<double> all(field.residual.data(), field.residual.data() + field.residual.size());
        error_ = field.residual.array() - median(all);
        Stream draws = seeded_stream(0, "demodulation");
        some_ = draws.permutation(field.count());
        some_.resize(std::min<std::size_t>(some_.size(), rough_samples));
        some_nuisance_ = taken(field.nuisance, some_);
        some_waves_ = taken(waves, some_);
        some_residual_ = taken(field.residual, some_);
    }

    /// \param vectors of the waves
    void run(const Points& vectors)
    {
        reweigh(most_steps);
        solve_all();
        if (groups_.size() > 1) {
            for (SampleGroup& group : groups_) {
                VectorXd own = VectorXd::Zero(weights_.size());
                for (const int i : group.members)
                    own[i] = weights_[i];
                group.inflation =
                    std::max(1.0, std::exp(inflation_of(field_, waves_.cols(), decoys_, own, error_).level));
            }
            reweigh(2);
            solve_all();
        }
        const Inflation fit = inflation_of(field_, waves_.cols(), decoys_, weights_, error_);
        for (Eigen::Index k = 0; k < inflation_.size(); ++k)
            inflation_[k] = fit.at(vectors[k].norm());
    }

    [[nodiscard]] Solution solution(std::size_t which) const
    {
        return solution_of(equations_, assumptions_[which], inflation_);
    }

private:
    void weigh_all()
    {
        weights_ = VectorXd::Zero(field_.count());
        for (const SampleGroup& group : groups_)
            weigh(group, error_, field_.floor * field_.floor, weights_);
    }

    /// Errors under the assumption that fits the equations best.
    void explain(const Reduced& equations)
    {
        std::size_t best = 0;
        Solution found;
        for (std::size_t i = 0; i < assumptions_.size(); ++i) {
            Solution one = solution_of(equations, assumptions_[i], inflation_);
            if (i == 0 || one.log_evidence > found.log_evidence) {
                found = std::move(one);
                best = i;
            }
        }
        const VectorXd amplitudes = assumptions_[best].middle + assumptions_[best].per_bit * found.bits;
        const VectorXd nuisance = equations.nuisance.solve(equations.answer - equations.cross * amplitudes);
        error_ = field_.residual - waves_ * amplitudes - field_.nuisance * nuisance;
    }

    void reweigh(int steps)
    {
        for (int step = 0; step < steps; ++step) {
            weigh_all();
            const VectorXd some = taken(weights_, some_);
            const VectorXd before = error_;
            explain(reduced(some_nuisance_, some_waves_, some_residual_, some));
            const double change = (error_ - before).cwiseAbs().maxCoeff();
            const double spread = std::sqrt(error_.squaredNorm() / static_cast<double>(error_.size()));
            if (step > 1 && change < 1e-2 * spread)
                break;
        }
    }

    void solve_all()
    {
        weigh_all();
        equations_ = reduced(field_.nuisance, waves_, field_.residual, weights_);
        explain(equations_);
    }

    const ResidualField& field_;
    const Rows& waves_;
    const std::vector<WaveAssumption>& assumptions_;
    std::vector<SampleGroup> groups_;
    std::vector<int> some_;
    Rows some_nuisance_, some_waves_;
    VectorXd some_residual_;
    Decoys decoys_;
    VectorXd error_, weights_, inflation_;
    Reduced equations_;
};

} // namespace

std::vector<Demodulated> demodulate(const ResidualField& field, const Rows& waves, const Points& vectors,
                                    const std::vector<WaveAssumption>& assumptions)
{
    std::vector<Demodulated> result(assumptions.size());
    if (field.count() <= waves.cols() + field.nuisance.cols()) {
        for (Demodulated& one : result) {
            one.soft.assign(static_cast<std::size_t>(waves.cols()), 0);
            one.weight = 1 / static_cast<double>(result.size());
        }
        return result;
    }
    Fit fit(field, waves, assumptions);
    fit.run(vectors);
    std::vector<double> evidence;
    for (std::size_t i = 0; i < assumptions.size(); ++i) {
        const Solution solution = fit.solution(i);
        Demodulated& one = result[i];
        for (Eigen::Index k = 0; k < solution.bits.size(); ++k)
            one.soft.push_back(std::clamp(2 * solution.bits[k] / (1 - solution.shrinkage[k]), -most_soft, most_soft));
        one.information = solution.information;
        evidence.push_back(solution.log_evidence);
    }
    const double most = *std::max_element(evidence.begin(), evidence.end());
    double sum = 0;
    for (const double one : evidence)
        sum += std::exp(one - most);
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i].weight = std::exp(evidence[i] - most) / sum;
    return result;
}

} // namespace vcg_ext
