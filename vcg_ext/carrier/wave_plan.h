// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../key/key.h"
#include "wave_body.h"

#include <complex>
#include <vector>

namespace vcg_ext {

constexpr double shortest_wave = 10; ///< |q|: waves of .63 r, some .14 of a diagonal
constexpr double longest_wave = 20;

/// The waves that carry the bits, one each, as both sides draw them from the key. Bit b of wave k asks for
/// m_k = D (integer + dither_k + b / 2), where m_k = 1 / (4 pi) * integral over the solid of cos(q_k . x + phase_k).
struct WavePlan {
    Points vectors;              ///< q_k: uniform in the shell 10 <= |q| <= 20, radians per radius of the solid's ball
    std::vector<double> phases;  ///< in [0, 2 pi)
    std::vector<double> dithers; ///< in [0, 1)

    [[nodiscard]] int count() const { return static_cast<int>(vectors.size()); }
};

[[nodiscard]] WavePlan wave_plan(const Key& key, int count);

/// Wave vectors, uniform in the shell. \param draws three numbers a trial, until there are enough
[[nodiscard]] Points wave_vectors(Stream& draws, int count);

/// The step D in which a displacement of `strength` (RMS over the diagonal) is to be expected if waves go nine tenths
/// of the way to their targets, on a ladder of four rungs an octave: D = strength sqrt(12) A r^-3 diagonal / (4 pi) /
/// sqrt(2 K) / .9. A wave of amplitude a over the whole surface A changes its own m by a A / (8 pi r^3) in canonical
/// units, targets are uniform within half a step, and K waves add up.
///
/// \param rung the result's place on the ladder
[[nodiscard]] double wave_step(const WaveBody& body, double strength, int waves, int* rung = nullptr);

/// 2^(rung / 4)
[[nodiscard]] double step_of_rung(int rung);

constexpr double usual_part = 0.9; ///< of the way to their lattice that waves go, more or less

/// The m_k of a body's transform at its waves. \param mirrored of the body's mirror image
[[nodiscard]] std::vector<double> wave_values_of(const std::vector<std::complex<double>>& transform,
                                                 const std::vector<double>& phases, bool mirrored);

} // namespace vcg_ext
