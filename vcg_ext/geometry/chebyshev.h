// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "laplacian.h"

namespace vcg_ext {

/// A polynomial p of a Laplacian that is near 0 on low and near 1 on high eigenvalues, as a Chebyshev series on
/// [0, bound].
struct HighPass {
    double bound = 0;                 ///< the eigenvalues are in [0, bound]
    std::vector<double> coefficients; ///< of T_0, T_1, ... at 2 lambda / bound - 1

    /// p at one eigenvalue, in [0, 1] (Jackson's kernel is positive).
    [[nodiscard]] double transfer(double eigenvalue) const;
};

/// The step at `cutoff`, damped by Jackson's kernel so that it does not ring (Weisse et al. 2006, Rev. Mod. Phys. 78).
///
/// In the angle arccos(2 lambda / bound - 1) the transition is pi / (terms + 1) wide as a standard deviation, whatever
/// the eigenvalue.
/// \param cutoff in (0, bound)
/// \param degree at least 1; it is also the number of sparse products
[[nodiscard]] HighPass high_pass(double cutoff, double bound, int degree);

/// The degree at which high_pass() has the same transition for every bound: 120 at a bound of 24, and as its root.
[[nodiscard]] int high_pass_degree(double bound);

/// p(L) x: the high band of functions on the vertices, three at a time. Each row of each product is written by one
/// thread alone, so the result is the same at any number of threads.
[[nodiscard]] Points apply(const HighPass& filter, const EdgeGraph& graph, Points x);

/// What moves of some vertices do to a band: adds p(L) of them. It reaches as many edges far as the degree is high, so
/// where few vertices move it costs less than the whole band.
/// \param band  of each vertex
/// \param moved ascending  \param moves of each of these
void add_band_of_moves(const HighPass& filter, const EdgeGraph& graph, const std::vector<int>& moved,
                       const Points& moves, Points& band);

} // namespace vcg_ext
