// SPDX-License-Identifier: GPL-3.0-or-later
#include "demodulation.h"

#include "../base/median.h"
#include "../base/parallel.h"
#include "../base/pi.h"
#include "../geometry/wave_values.h"
#include "../key/random.h"
#include "wave_plan.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace vcg_ext {

namespace {

constexpr double nu = 3;             ///< degrees of freedom of the noise
constexpr double cell = 0.15;        ///< side of the cells in which the noise has one spread
constexpr double pseudo_samples = 8; ///< of the kind's spread, in each cell
constexpr double kind_share = 0.25;  ///< of the kind's variance, added in each cell
constexpr double outlier = 36;       ///< squared errors count up to so many times the kind's variance
constexpr int bins = 16;             ///< of roughness
constexpr int rough_samples = 8000;  ///< for all but the last steps
constexpr int most_steps = 8;
constexpr int decoys = 96;
constexpr double most_soft = 6;
constexpr double middle_length = 15; ///< |q| about which decoys are fitted, in units of
constexpr double length_unit = 5;

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Sum over rows of w x y^T, in pieces that do not depend on the number of threads.
template <class X, class Y>
MatrixXd weighted_product(const X& x, const VectorXd& w, const Y& y)
{
    constexpr int chunk = 2048;
    const int rows = static_cast<int>(x.rows());
    std::vector<MatrixXd> parts(chunk_count(rows, chunk));
    for_chunks(rows, chunk, [&](int begin, int end) {
        const int n = end - begin;
        parts[begin / chunk] =
            x.middleRows(begin, n).transpose() * (w.segment(begin, n).asDiagonal() * y.middleRows(begin, n));
    });
    MatrixXd sum = MatrixXd::Zero(x.cols(), y.cols());
    for (const MatrixXd& part : parts)
        sum += part;
    return sum;
}

/// Places of equal key get equal numbers.
template <class Key>
std::vector<int> numbered(const std::vector<Key>& keys)
{
    std::vector<Key> sorted = keys;
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    std::vector<int> numbers;
    numbers.reserve(keys.size());
    for (const Key& key : keys)
        numbers.push_back(static_cast<int>(std::lower_bound(sorted.begin(), sorted.end(), key) - sorted.begin()));
    return numbers;
}

/// Samples of one kind, and the groups in which they share a spread.
struct Group {
    std::vector<int> members;
    std::vector<int> cells; ///< per member
    std::vector<int> bins;  ///< per member, by roughness
    double inflation = 1;   ///< of the noise in the waves' band
};

Group group_of(const ResidualField& field, int kind)
{
    Group group;
    std::vector<std::array<int, 3>> cells;
    std::vector<std::pair<double, int>> order;
    for (int i = 0; i < field.count(); ++i) {
        if (field.kind[i] != kind)
            continue;
        const Point& p = field.places[i];
        cells.push_back({static_cast<int>(std::floor(p[0] / cell)), static_cast<int>(std::floor(p[1] / cell)),
                         static_cast<int>(std::floor(p[2] / cell))});
        order.emplace_back(field.roughness[i], static_cast<int>(group.members.size()));
        group.members.push_back(i);
    }
    group.cells = numbered(cells);
    std::sort(order.begin(), order.end());
    group.bins.resize(order.size());
    for (std::size_t rank = 0; rank < order.size(); ++rank)
        group.bins[order[rank].second] = static_cast<int>(rank * bins / order.size());
    return group;
}

/// Weights of a group's samples: one over the variance that each seems to have, and Student's law on top.
void weigh(const Group& group, const VectorXd& error, double floor, VectorXd& weights)
{
    const std::size_t n = group.members.size();
    std::vector<double> sizes;
    for (const int i : group.members)
        sizes.push_back(std::abs(error[i]));
    const double middle = median(sizes);
    double variance = floor;
    for (const double size : sizes)
        variance += std::min(size * size, outlier * 2.2 * middle * middle) / static_cast<double>(n);
    const auto squared = [&](std::size_t m) { return std::min(sizes[m] * sizes[m], outlier * variance); };

    const int cells = 1 + *std::max_element(group.cells.begin(), group.cells.end());
    std::vector<double> in_cell(cells, pseudo_samples * variance);
    std::vector<double> held(cells, pseudo_samples);
    for (std::size_t m = 0; m < n; ++m) {
        in_cell[group.cells[m]] += squared(m);
        held[group.cells[m]] += 1;
    }
    std::vector<double> local(n);
    for (std::size_t m = 0; m < n; ++m)
        local[m] = in_cell[group.cells[m]] / held[group.cells[m]] + kind_share * variance;
    if (n > 400) {
        std::array<double, bins> ratio{};
        std::array<double, bins> count{};
        for (std::size_t m = 0; m < n; ++m) {
            ratio[group.bins[m]] += squared(m) / local[m];
            count[group.bins[m]] += 1;
        }
        for (std::size_t m = 0; m < n; ++m)
            local[m] *= std::clamp(ratio[group.bins[m]] / std::max(count[group.bins[m]], 1.0) + 0.02, 0.02, 50.0);
    }
    for (std::size_t m = 0; m < n; ++m) {
        const double v = local[m] + floor;
        weights[group.members[m]] = (nu + 1) / (nu + sizes[m] * sizes[m] / v) / v / group.inflation;
    }
}

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

/// Waves that no mark has, at the samples' places.
Rows decoy_values(const Points& places, std::vector<double>& lengths)
{
    Stream draws = seeded_stream(0, "decoy waves");
    const Points vectors = wave_vectors(draws, decoys);
    std::vector<double> phases;
    for (const Point& q : vectors) {
        phases.push_back(2 * pi * uniform(draws));
        lengths.push_back(q.norm());
    }
    const std::vector<double> values = wave_values(places, vectors, phases);
    return Eigen::Map<const Rows>(values.data(), static_cast<Eigen::Index>(places.size()), decoys);
}

/// How much more noise there is in the waves' band than the weights say: log-linear in |q|.
struct Inflation {
    double level = 0;
    double slope = 0;

    [[nodiscard]] double at(double length) const
    {
        return std::max(1.0, std::exp(level + slope * (length - middle_length) / length_unit));
    }
};

/// By (sum w d e)^2 / sum w d^2 over decoys d, which is 1 on average where the weights are right.
Inflation inflation_of(const ResidualField& field, Eigen::Index waves, const Rows& decoy,
                       const std::vector<double>& lengths, const VectorXd& weights, const VectorXd& error)
{
    MatrixXd own = weighted_product(field.nuisance, weights, field.nuisance);
    own.diagonal().array() += 1e-9 * own.trace() / static_cast<double>(own.rows());
    const MatrixXd cross = weighted_product(field.nuisance, weights, decoy);
    const MatrixXd solved = own.ldlt().solve(cross);
    const VectorXd answer = weighted_product(field.nuisance, weights, error);
    const VectorXd seen = weighted_product(decoy, weights, error) - solved.transpose() * answer;
    const VectorXd size = (weighted_product(Rows(decoy.cwiseAbs2()), weights, VectorXd(VectorXd::Ones(decoy.rows()))) -
                           cross.cwiseProduct(solved).colwise().sum().transpose())
                              .cwiseMax(1e-300);
    const double effective = weights.sum() * weights.sum() / std::max(weights.squaredNorm(), 1e-300);
    const double unknowns = static_cast<double>(field.nuisance.cols() + waves);
    const double left = std::max(0.3, 1 - unknowns / std::max(effective, 1.0));
    const VectorXd power = seen.cwiseAbs2().cwiseQuotient(size) / left;

    // Gamma regression with a logarithmic link, by Fisher's scoring; the slope held a little towards none.
    constexpr double hold = 3;
    Inflation fit;
    fit.level = std::log(power.mean() + 1e-9);
    for (int step = 0; step < 15; ++step) {
        Eigen::Matrix2d normal = Eigen::Vector2d(0, hold).asDiagonal();
        Eigen::Vector2d right(0, -hold * fit.slope);
        for (int d = 0; d < decoys; ++d) {
            const Eigen::Vector2d line(1, (lengths[d] - middle_length) / length_unit);
            const double mean = std::exp(fit.level + fit.slope * line[1]);
            normal += line * line.transpose();
            right += line * (power[d] - mean) / mean;
        }
        const Eigen::Vector2d change = normal.ldlt().solve(right);
        fit.level = std::clamp(fit.level + change[0], -20.0, 20.0);
        fit.slope = std::clamp(fit.slope + change[1], -20.0, 20.0);
    }
    return fit;
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
        : field_(field), waves_(waves), assumptions_(assumptions), inflation_(VectorXd::Ones(waves.cols()))
    {
        for (const int kind : {0, 1}) {
            Group group = group_of(field, kind);
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
        decoys_ = decoy_values(field.places, decoy_lengths_);
    }

    /// \param vectors of the waves
    void run(const Points& vectors)
    {
        reweigh(most_steps);
        solve_all();
        if (groups_.size() > 1) {
            for (Group& group : groups_) {
                VectorXd own = VectorXd::Zero(weights_.size());
                for (const int i : group.members)
                    own[i] = weights_[i];
                group.inflation = std::max(
                    1.0, std::exp(inflation_of(field_, waves_.cols(), decoys_, decoy_lengths_, own, error_).level));
            }
            reweigh(2);
            solve_all();
        }
        const Inflation fit = inflation_of(field_, waves_.cols(), decoys_, decoy_lengths_, weights_, error_);
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
        for (const Group& group : groups_)
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
    std::vector<Group> groups_;
    std::vector<int> some_;
    Rows some_nuisance_, some_waves_;
    VectorXd some_residual_;
    std::vector<double> decoy_lengths_;
    Rows decoys_;
    VectorXd error_, weights_, inflation_;
    Reduced equations_;
};

} // namespace

void put_affine(Rows::RowXpr row, const Point& place, const Point& normal)
{
    row.head<3>() = normal;
    for (int a = 0; a < 3; ++a)
        row.segment<3>(3 + 3 * a) = place[a] * normal;
}

void to_unit_rms(Rows& columns)
{
    for (Eigen::Index c = 0; c < columns.cols(); ++c) {
        const double rms = std::sqrt(columns.col(c).squaredNorm() / static_cast<double>(columns.rows()));
        columns.col(c) /= std::max(rms, 1e-12);
    }
}

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
