// SPDX-License-Identifier: GPL-3.0-or-later
#include "wave_spectra.h"

#include "../base/parallel.h"
#include "../geometry/wave_sums.h"
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

/// Body turned by half a turn about one of its axes, or not at all: signs of the coordinates.
Point signs_of(int orientation)
{
    const Point signs[4] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    return signs[orientation];
}

/// Canonical coordinates of `points`, which are canonical ones of the body, displaced; none where they bound nothing.
Points canonical_again(const WaveBody& body, const Points& points)
{
    Frame frame = solid_frame(points, body.topology.triangles);
    if (frame.measure * body.frame.measure <= 0)
        return {};
    align_axes(frame, Eigen::Matrix3d::Identity()); // the same way round as before
    const double r = ball_radius(frame);
    Points result(points.size());
    for_each_index(static_cast<int>(points.size()),
                   [&](int v) { result[v] = frame.axes.transpose() * (points[v] - frame.centre) / r; });
    return result;
}

} // namespace

WaveSpectra::WaveSpectra(WaveBody body, int orientations) : body_(std::move(body)), orientations_(orientations)
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
        for (int o = 0; o < orientations_; ++o)
            waves.emplace_back(plan.vectors[k].cwiseProduct(signs_of(o)));
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
