// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "residual_field.h"

namespace vcg_ext {

/// Samples of one kind, and the groups in which they share a spread.
struct SampleGroup {
    std::vector<int> members;
    std::vector<int> cells; ///< per member
    std::vector<int> bins;  ///< per member, by roughness
    double inflation = 1;   ///< of the noise in the waves' band
};

[[nodiscard]] SampleGroup group_of(const ResidualField& field, int kind);

/// Writes the weights of a group's samples: one over the variance that each seems to have, by its kind, place and
/// roughness, and Student's law on top.
/// \param error of all samples   \param floor of the variance
void weigh(const SampleGroup& group, const Eigen::VectorXd& error, double floor, Eigen::VectorXd& weights);

} // namespace vcg_ext
