// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

#include <vector>

namespace vcg_ext {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// How far samples of a copy lie off its original, and what may have put them there. Lengths in radii of the original.
struct ResidualField {
    Eigen::VectorXd residual; ///< distance along the original's normal, outward positive
    Rows nuisance;         ///< a column for each thing else that moves a surface: shifts, turns, stretches, curvature
    Points places;         ///< on the original
    std::vector<int> kind; ///< of sample, 0 or 1: their noise differs
    std::vector<double> roughness; ///< grows with the error that the mesh itself makes there
    double floor = 0;              ///< of the noise's standard deviation

    [[nodiscard]] int count() const { return static_cast<int>(residual.size()); }
};

/// The first twelve columns of a row of nuisance: how far shifts and linear maps of the copy move it along the normal.
void put_affine(Rows::RowXpr row, const Point& place, const Point& normal);

/// Scales each column to RMS 1, so that no unit decides how well the equations are conditioned.
void to_unit_rms(Rows& columns);

} // namespace vcg_ext
