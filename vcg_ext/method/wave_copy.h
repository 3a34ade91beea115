// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../carrier/demodulation.h"
#include "../geometry/unsmoothing.h"
#include "../placement/wave_reply.h"
#include "copy.h"

namespace vcg_ext {

/// Of the diagonal: what rounding to float leaves of a residual field.
constexpr double floor_of_noise = 2e-6;

/// Samples of a copy at their feet on the original, or on the original after some rounds of smoothing; how it was
/// marked has no part in it.
class WaveCopy {
public:
    explicit WaveCopy(const Copy& copy);

    /// The original.
    [[nodiscard]] const WaveBody& body() const { return body_; }

    /// Of the original too: means over patches, where noise drowns what single samples say.
    [[nodiscard]] const Impression& impression() const { return impression_; }

    /// One way to see what was done to the copy.
    struct State {
        int rounds = 0;    ///< of smoothing with uniform weights, by a half, before it was registered
        double weight = 1; ///< fixed before looking at what it says; all sum to 1
        Registration registration;
        ResidualField field; ///< but for the waves
        std::vector<Foot> feet;
        Points normals; ///< where the samples stand, outward, in the original's frame
        /// Where smoothing went over the copy's own edges: per vertex its place on the original, and the vertices that are
        /// samples.
        std::vector<Foot> places;
        std::vector<int> vertices;
    };

    [[nodiscard]] const std::vector<State>& states() const { return states_; }

    /// ResidualField::waves of a state: the waves as smoothing leaves them, at the feet, along the normals there.
    [[nodiscard]] Rows waves(const State& state, const WaveField& field, const WavePlan& plan) const;

private:
    void look(const Copy& copy, const FootSearch& feet, State state);
    void look_before_smoothing(const Copy& copy, const State& worn);
    void add(const Unsmoothed& way, const Surface& surface, double weight);

    WaveBody body_;
    Impression impression_;
    EdgeGraph graph_;
    EdgeGraph copy_graph_; ///< where it was smoothed over edges of its own
    Points directions_;
    std::vector<State> states_;
};

} // namespace vcg_ext
