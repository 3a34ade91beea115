// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "residual_field.h"

namespace vcg_ext {

/// One assumption of how bits became amplitudes: amplitudes = middle + per_bit c, c = +-1.
struct WaveAssumption {
    double log_prior = 0; ///< natural logarithm
    Eigen::VectorXd middle;
    Eigen::MatrixXd per_bit;
};

struct Demodulated {
    double weight = 0; ///< posterior of the assumption; all sum to 1
    /// Log-likelihood ratio of each bit, positive for c = 1, within +-6: beyond, the model is not to be trusted.
    std::vector<double> soft;
    double information = 0; ///< mean per bit: squared signal over noise
};

/// What a residual field says of each bit, under each of some assumptions.
///
/// r = W (middle + P c) + Z b + e, with c ~ N(0, 1) for want of a better law, b free and e of Student's law (nu = 3)
/// whose spread depends on the kind of sample, on the place (cells, shrunk to the kind's mean) and on the roughness;
/// iteratively reweighted. How noise gathers in the band of the waves is measured by other waves of the same shell,
/// and divides the likelihood. Nothing looks at the mask, and given all that comes out the signs of `soft` against bits
/// under a secret mask are fair coins: whatever is chosen or weighted here costs a probability nothing.
///
/// Fewer samples than unknowns say nothing: soft values of 0.
///
/// \param waves   a row a sample, a column a wave: what amplitude 1 does there
/// \param vectors of the waves
[[nodiscard]] std::vector<Demodulated> demodulate(const ResidualField& field, const Rows& waves, const Points& vectors,
                                                  const std::vector<WaveAssumption>& assumptions);

} // namespace vcg_ext
