// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "residual_field.h"

namespace vcg_ext {

/// How much more noise there is in the waves' band than the weights say: log-linear in |q|.
struct Inflation {
    double level = 0;
    double slope = 0;

    /// By what it divides the likelihood of a wave of |q| = length.
    [[nodiscard]] double at(double length) const;
};

/// Waves of the same shell that no mark has, at the samples' places.
struct Decoys {
    explicit Decoys(const Points& places);

    std::vector<double> lengths; ///< |q|
    Rows values;                 ///< a row a sample, a column a wave
};

/// By (sum w d e)^2 / sum w d^2 over decoys d, which is 1 on average where the weights are right.
/// \param waves how many were fitted beside the nuisance
[[nodiscard]] Inflation inflation_of(const ResidualField& field, Eigen::Index waves, const Decoys& decoys,
                                     const Eigen::VectorXd& weights, const Eigen::VectorXd& error);

} // namespace vcg_ext
