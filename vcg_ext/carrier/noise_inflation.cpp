// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise_inflation.h"

#include "../base/pi.h"
#include "../geometry/wave_values.h"
#include "../key/random.h"
#include "wave_plan.h"
#include "weighted_product.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace vcg_ext {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int count = 96;            ///< of decoys
constexpr double middle_length = 15; ///< |q| about which decoys are fitted, in units of
constexpr double length_unit = 5;

/// Gamma regression with a logarithmic link, by Fisher's scoring; the slope held a little towards none.
Inflation fit_of(const VectorXd& power, const std::vector<double>& lengths)
{
    constexpr double hold = 3;
    Inflation fit;
    fit.level = std::log(power.mean() + 1e-9);
    for (int step = 0; step < 15; ++step) {
        Eigen::Matrix2d normal = Eigen::Vector2d(0, hold).asDiagonal();
        Eigen::Vector2d right(0, -hold * fit.slope);
        for (int d = 0; d < count; ++d) {
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

} // namespace

double Inflation::at(double length) const
{
    return std::max(1.0, std::exp(level + slope * (length - middle_length) / length_unit));
}

Decoys::Decoys(const Points& places)
{
    Stream draws = seeded_stream(0, "decoy waves");
    const Points vectors = wave_vectors(draws, count);
    std::vector<double> phases;
    for (const Point& q : vectors) {
        phases.push_back(2 * pi * uniform(draws));
        lengths.push_back(q.norm());
    }
    const std::vector<double> all = wave_values(places, vectors, phases);
    values = Eigen::Map<const Rows>(all.data(), static_cast<Eigen::Index>(places.size()), count);
}

Inflation inflation_of(const ResidualField& field, Eigen::Index waves, const Decoys& decoys, const VectorXd& weights,
                       const VectorXd& error)
{
    MatrixXd own = weighted_product(field.nuisance, weights, field.nuisance);
    own.diagonal().array() += 1e-9 * own.trace() / static_cast<double>(own.rows());
    const MatrixXd cross = weighted_product(field.nuisance, weights, decoys.values);
    const MatrixXd solved = own.ldlt().solve(cross);
    const VectorXd answer = weighted_product(field.nuisance, weights, error);
    const VectorXd seen = weighted_product(decoys.values, weights, error) - solved.transpose() * answer;
    const VectorXd size =
        (weighted_product(Rows(decoys.values.cwiseAbs2()), weights, VectorXd(VectorXd::Ones(decoys.values.rows()))) -
         cross.cwiseProduct(solved).colwise().sum().transpose())
            .cwiseMax(1e-300);
    const double effective = weights.sum() * weights.sum() / std::max(weights.squaredNorm(), 1e-300);
    const double unknowns = static_cast<double>(field.nuisance.cols() + waves);
    const double left = std::max(0.3, 1 - unknowns / std::max(effective, 1.0));
    const VectorXd power = seen.cwiseAbs2().cwiseQuotient(size) / left;
    return fit_of(power, decoys.lengths);
}

} // namespace vcg_ext
