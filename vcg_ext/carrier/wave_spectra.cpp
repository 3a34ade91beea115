// SPDX-License-Identifier: GPL-3.0-or-later
#include "wave_spectra.h"

#include "../base/parallel.h"
#include "../geometry/solid_transform.h"
#include "wave_flows.h"

#include <algorithm>

namespace vcg_ext {

namespace {

constexpr double flow_step = 2e-4; ///< in radii: that the flows' derivatives are taken over

constexpr double smoothing_lambda = 0.5;
constexpr int series_terms = 6;
/// On finer meshes rounds of smoothing move nothing that `bend` and `relax` would not describe.
constexpr int most_sites_undone = 400000;

/// Area that a surface may reach, over what it is: undoing more smoothing than there was crumples it, at some length.
constexpr double most_area = 3;

/// Canonical coordinates of `points`, which are canonical ones of the body, displaced; none where they bound nothing.
Points canonical_again(const WaveBody& body, const Points& points)
{
    const Frame frame = frame_again(body, points, Eigen::Matrix3d::Identity());
    return frame.measure * body.frame.measure > 0 ? canonical(frame, points) : Points();
}

} // namespace

WaveSpectra::WaveSpectra(WaveBody body) : body_(std::move(body))
{
    states_.emplace_back(body_.points);
}

void WaveSpectra::process()
{
    if (states_.size() > 1)
        return;
    const Points normals = site_normals(body_);
    for (const std::vector<double>& flow : processing_flows(body_, normals)) {
        Points points = body_.points;
        for_each_index(body_.topology.sites, [&](int v) { points[v] += flow_step * flow[v] * normals[v]; });
        place_apexes(body_.topology, points);
        states_.emplace_back(canonical_again(body_, points));
    }
    if (body_.topology.sites > most_sites_undone)
        return;
    const std::vector<Points> powers = umbrella_powers(body_, series_terms);
    for (std::size_t i = 1; i < nodes.size(); ++i) {
        Points points = canonical_again(body_, before_smoothing(body_, powers, smoothing_lambda, nodes[i]));
        if (points.empty() || area_of(body_, points) > most_area * body_.area)
            return;
        states_.emplace_back(std::move(points));
    }
}

const WaveSpectra::Spectrum& WaveSpectra::spectrum(State& state, const WavePlan& plan)
{
    const int known = static_cast<int>(state.vectors.size());
    const bool longer =
        std::equal(state.vectors.begin(), state.vectors.begin() + std::min(known, plan.count()), plan.vectors.begin());
    if (!longer)
        state = State(std::move(state.points));
    Points waves;
    for (int k = static_cast<int>(state.vectors.size()); k < plan.count(); ++k) {
        state.vectors.push_back(plan.vectors[k]);
        for (const Eigen::Matrix3d& turn : body_.turns)
            waves.emplace_back(turn.transpose() * plan.vectors[k]);
    }
    if (waves.empty())
        return state.spectrum;
    if (state.points.empty()) { // nothing is known of it
        state.spectrum.resize(state.spectrum.size() + waves.size());
        return state.spectrum;
    }
    const double side = body_.frame.measure < 0 ? -1 : 1; // inside out
    for (const std::complex<double>& value :
         solid_transform(state.points, body_.topology.triangles, waves, longest_wave))
        state.spectrum.push_back(side * value);
    return state.spectrum;
}

const WaveSpectra::Spectrum& WaveSpectra::at_rest(const WavePlan& plan)
{
    return spectrum(states_[0], plan);
}

std::array<WaveSpectra::Spectrum, 2> WaveSpectra::flows(const WavePlan& plan)
{
    process();
    const Spectrum& rest = at_rest(plan);
    std::array<Spectrum, 2> result;
    for (int flow = 0; flow < 2; ++flow) {
        State& state = states_[1 + flow];
        result[flow] = spectrum(state, plan);
        for (std::size_t i = 0; i < result[flow].size(); ++i)
            result[flow][i] = state.points.empty() ? 0 : (result[flow][i] - rest[i]) / flow_step;
    }
    return result;
}

std::vector<const WaveSpectra::Spectrum*> WaveSpectra::unsmoothed(const WavePlan& plan)
{
    process();
    std::vector<const Spectrum*> result;
    if (body_.topology.sites > most_sites_undone)
        return result;
    result.push_back(&at_rest(plan));
    for (std::size_t i = 3; i < states_.size(); ++i)
        result.push_back(&spectrum(states_[i], plan));
    return result;
}

} // namespace vcg_ext
