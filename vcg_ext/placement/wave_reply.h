// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "wave_field.h"

#include <Eigen/LU>

namespace vcg_ext {

/// A step in which the embedder may have counted, and what it then did to a body whose m_k are known: with every bit
/// c_k = +-1 (a coded bit of 1 is +1) the field is the sum of waves with the amplitudes `middle` + `per_bit` c.
///
/// The lattice points next to the host's m_k, one for each bit, lie half a step apart: so three quarters of the mark's
/// energy on average is of known size and unknown sign, and the rest is known.
struct WaveMoves {
    int rung = 0;
    Eigen::VectorXd middle;
    Eigen::MatrixXd per_bit; ///< a column a bit
};

/// What embedding with the step of a rung does, where each wave goes the usual part of the way to its nearest target.
/// \param values of the body: the m_k  \param derivative of these by the amplitudes
[[nodiscard]] WaveMoves wave_moves(const WavePlan& plan, const std::vector<double>& values,
                                   const Eigen::PartialPivLU<Eigen::MatrixXd>& derivative, int rung);

/// How a body answers to waves on its surface, to first order.
class WaveReply {
public:
    /// \param body must outlive it
    WaveReply(const WaveBody& body, const WavePlan& plan);
    WaveReply(const WaveReply&) = delete;
    WaveReply& operator=(const WaveReply&) = delete;

    /// Derivative of the m_k by the amplitudes, a column an amplitude: what the waves do to the solid, and what the
    /// frame does to the m_k, as it moves along: G / (4 pi) + J M.
    [[nodiscard]] const Eigen::MatrixXd& derivative() const { return derivative_; }

    /// The m_k of the body.
    [[nodiscard]] const std::vector<double>& values() const { return values_; }

    [[nodiscard]] const WaveField& field() const { return field_; }

    [[nodiscard]] WaveMoves moves(int rung) const { return wave_moves(plan_, values_, solver_, rung); }

private:
    WavePlan plan_;
    WaveField field_;
    std::vector<double> values_;
    Eigen::MatrixXd derivative_;
    Eigen::PartialPivLU<Eigen::MatrixXd> solver_;
};

} // namespace vcg_ext
