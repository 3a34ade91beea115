// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cover.h"

#include <array>

namespace vcg_ext {

/// k1, k2, k3 of (5.24): distance to the cover's planes, to the planes as the neighbours now are, and from the old
/// place.
using SphereWeights = std::array<double, 3>;

/// The quadratic form A of the energy (5.23), E(d) = d^T A d with d = v^ - v, for vertex `v` of the cover and its
/// neighbours at `current`. The normals n^_j are those of the faces with `v` at its old place: that makes (5.28) hold.
[[nodiscard]] Eigen::Matrix3d sphere_energy(const Cover& cover, const Points& current, int v,
                                            const SphereWeights& weights);

/// The same with the neighbours still on the cover, where n^_j = n_j.
[[nodiscard]] Eigen::Matrix3d sphere_energy(const Cover& cover, int v, const SphereWeights& weights);

struct SphereOptions {
    SphereWeights weights = {0.49, 0.49, 0.02}; ///< not negative, not all zero
    /// Jacobi sweeps: the first sees the neighbours on the cover, the next where the one before put them. More than one
    /// gains nothing: MRMS grows by 0 to 12 % (tests/benchmark/norm_methods).
    int sweeps = 1;
};

/// Iterations of the sphere placement per moved vertex.
struct SolverSummary {
    double mean_iterations = 0;
    int max_iterations = 0;
    int not_converged = 0;
};

struct SphereSolution {
    Point point;
    int iterations = 0;
    bool converged = false;
};

/// Minimises d^T A d over the sphere |v^ - centre| = norm by Levenberg-Marquardt in two angles ((5.31)-(5.37)), from
/// the linear solution at Cho's point. \param energy A, symmetric and positive semi-definite  \pre v != centre
[[nodiscard]] SphereSolution place_on_sphere(const Point& v, const Point& centre, double norm,
                                             const Eigen::Matrix3d& energy);

} // namespace vcg_ext
