// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "wave_plan.h"

#include <array>
#include <deque>
#include <utility>

namespace vcg_ext {

/// Fourier transforms of a body, at rest and in the states that processing may have brought it from, at the waves of a
/// plan. What was computed for one plan is kept: one of the same key with more waves takes the difference only.
class WaveSpectra {
public:
    /// lambda k. Phases between are interpolated, within each run of four gaps by itself: where the mesh is rough, the
    /// series runs away soon, and must not spoil what lies before.
    static constexpr std::array<double, 17> nodes = {0, 0.375, 0.75, 1.125, 1.5,   2,    2.5,   3, 3.5,
                                                     4, 4.5,   5,    5.5,   6.125, 6.75, 7.375, 8};
    static constexpr int gaps = 4;

    /// Wave by wave, and of each wave one value for each of the body's turns.
    using Spectrum = std::vector<std::complex<double>>;

    explicit WaveSpectra(WaveBody body);

    [[nodiscard]] const WaveBody& body() const { return body_; }

    [[nodiscard]] const Spectrum& at_rest(const WavePlan& plan);

    /// Derivatives where the surface moves along its normals by each of processing_flows(). Zero where the body would
    /// then bound nothing.
    [[nodiscard]] std::array<Spectrum, 2> flows(const WavePlan& plan);

    /// With smoothing (1 + lambda L)^k undone for lambda k at the nodes, from the first of them (0) on to where that
    /// tears the body; none where the mesh is too fine for its smoothing to need that.
    [[nodiscard]] std::vector<const Spectrum*> unsmoothed(const WavePlan& plan);

private:
    struct State {
        explicit State(Points canonical) : points(std::move(canonical)) {}

        Points points;  ///< canonical; none where they bound nothing
        Points vectors; ///< of the plan, as far as they are in the spectrum
        Spectrum spectrum;
    };

    void process();
    const Spectrum& spectrum(State& state, const WavePlan& plan);

    WaveBody body_;
    std::deque<State> states_; ///< at rest; then two flows, and those before smoothing; they stay where they are
};

} // namespace vcg_ext
