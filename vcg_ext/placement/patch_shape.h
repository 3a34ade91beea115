// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// Shape of one patch's high band: the ellipsoid of its spectral coefficients about the origin ((3.17), (3.18)).
///
/// With P the projector onto the band and V the patch's positions, the coefficients' covariance is V^T P V / n =
/// H^T H / n with H = P V. So neither the eigenvectors' signs nor a rotation within an eigenspace matters, and no
/// basis is needed.
struct PatchShape {
    int samples = 0;                                    ///< vertices
    Point variances = Point::Zero();                    ///< lambda_1 >= lambda_2 >= lambda_3 >= 0
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity(); ///< columns: the unit axes, in this order

    /// lambda_1 / lambda_3 (3.23), at least 1; 1 where there is nothing to compare, at most 1e6.
    [[nodiscard]] double ratio() const;
};

/// \param band the whole mesh's high band, one row per vertex
/// \param vertices those of the patch
[[nodiscard]] PatchShape patch_shape(const Points& band, const std::vector<int>& vertices);

/// The least change of the patch that gives its high band the ratio `ratio` (squash: at least, else at most), and at
/// least `energy` as lambda_1 (squash), else as each lambda_k.
///
/// Minimises the sum of (n . d)^2 + softness |d|^2 over the vertices' displacements d, with n the vertex normals:
/// what leaves the surface is seen, a move along it is cheap. The new band is taken to be H + d. Stationary points of
/// the Lagrangian are d = (n n^T + softness - B)^-1 B h, with B diagonal in the shape's axes and linear in the
/// conditions' multipliers; a dual ascent finds these. (3.21) instead takes all of the change from axes 2 and 3,
/// whatever that costs.
/// \param normals unit normals of `vertices`, one each
/// \param ratio above 1
/// \param energy 0 for none
/// \return one displacement per vertex of `vertices`; zeros where the shape already fulfils its conditions
[[nodiscard]] Points least_change(const PatchShape& shape, const Points& band, const Points& normals,
                                  const std::vector<int>& vertices, bool squash, double ratio, double energy);

/// The change that the thesis prints (3.21): axes 2 and 3 scaled to lambda_1 / lambda_k = `ratio`.
[[nodiscard]] Points printed_change(const PatchShape& shape, const Points& band, const std::vector<int>& vertices,
                                    double ratio);

} // namespace vcg_ext
