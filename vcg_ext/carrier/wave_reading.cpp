// SPDX-License-Identifier: GPL-3.0-or-later
#include "wave_reading.h"

#include <algorithm>
#include <cmath>

namespace vcg_ext {

namespace {

constexpr double plain_share = 0.7; ///< of the weight, for the orientation that the body itself tells
constexpr int gaps = WaveSpectra::gaps;
constexpr auto nodes = WaveSpectra::nodes;

/// Lagrange's weights at `s` of the nodes `first` to `first` + gaps.
std::array<double, gaps + 1> interpolation(double s, int first)
{
    std::array<double, gaps + 1> weights{};
    for (int i = 0; i <= gaps; ++i) {
        weights[i] = 1;
        for (int j = 0; j <= gaps; ++j)
            if (j != i)
                weights[i] *= (s - nodes[first + j]) / (nodes[first + i] - nodes[first + j]);
    }
    return weights;
}

double rms(const std::vector<double>& x)
{
    double sum = 0;
    for (const double value : x)
        sum += value * value;
    return std::sqrt(sum / std::max<std::size_t>(1, x.size()));
}

/// Scales to an RMS of half a period; nothing where the column is zero.
void to_half_a_period(std::vector<double>& column)
{
    const double size = rms(column);
    for (double& x : column)
        x *= size > 0 ? 0.5 / size : 0;
}

/// Takes off `column` what it has of `other`.
void make_square(std::vector<double>& column, const std::vector<double>& other)
{
    double dot = 0;
    double square = 0;
    for (std::size_t k = 0; k < column.size(); ++k) {
        dot += other[k] * column[k];
        square += other[k] * other[k];
    }
    if (square > 0)
        for (std::size_t k = 0; k < column.size(); ++k)
            column[k] -= dot / square * other[k];
}

/// Phases for each lambda k of `wanted`, from values at the nodes, as far as these go.
std::vector<std::vector<double>> interpolated(const std::vector<std::vector<double>>& at_nodes,
                                              const std::vector<double>& wanted, const std::vector<double>& dithers)
{
    std::vector<std::vector<double>> phases;
    for (const double s : wanted) {
        int first = 0;
        while (first + gaps + 1 < static_cast<int>(nodes.size()) && nodes[first + gaps] < s)
            first += gaps;
        if (first + gaps >= static_cast<int>(at_nodes.size()))
            break;
        const auto weights = interpolation(s, first);
        std::vector<double> phase(dithers.size());
        for (std::size_t k = 0; k < phase.size(); ++k) {
            phase[k] = -dithers[k];
            for (int i = 0; i <= gaps; ++i)
                phase[k] += weights[i] * at_nodes[first + i][k];
        }
        phases.push_back(std::move(phase));
    }
    return phases;
}

/// The views that are read, and what each weighs: settled before any phase is.
std::vector<WaveView> views_to_try(const WaveBody& body, int waves, const WaveReadOptions& options)
{
    const int orientations = static_cast<int>(body.turns.size());
    int own_rung = 0;
    (void)wave_step(body, options.strength, waves, &own_rung);
    const int ways_round = orientations * (options.mirrored ? 2 : 1);
    double rung_sum = 0;
    for (int j = options.lowest_rung; j <= options.highest_rung; ++j)
        rung_sum += std::pow(rung_fall, std::abs(j));

    std::vector<WaveView> views;
    for (int j = options.lowest_rung; j <= options.highest_rung; ++j)
        for (int way = 0; way < ways_round; ++way) {
            WaveView view;
            view.orientation = way % orientations;
            view.mirrored = way >= orientations;
            view.rung = own_rung + j;
            view.step = step_of_rung(view.rung);
            const double share = ways_round == 1 ? 1 : way == 0 ? plain_share : (1 - plain_share) / (ways_round - 1);
            view.log_weight = std::log(share * std::pow(rung_fall, std::abs(j)) / rung_sum);
            views.push_back(std::move(view));
        }
    return views;
}

/// What a spectrum comes to in one view, in its steps. \param spectrum of the plan's waves, and perhaps of more
std::vector<double> in_steps(const WaveSpectra::Spectrum& spectrum, std::size_t orientations, const WavePlan& plan,
                             const WaveView& view)
{
    const std::size_t count = plan.vectors.size();
    std::vector<std::complex<double>> own(count);
    for (std::size_t k = 0; k < count; ++k)
        own[k] = spectrum[k * orientations + view.orientation];
    std::vector<double> values = wave_values_of(own, plan.phases, view.mirrored);
    for (double& value : values)
        value /= view.step;
    return values;
}

} // namespace

WaveReading read_waves(WaveSpectra& spectra, const WavePlan& plan, const WaveReadOptions& options)
{
    WaveReading reading{views_to_try(spectra.body(), plan.count(), options), &wave_grid()};
    const std::size_t orientations = spectra.body().turns.size();
    const WaveSpectra::Spectrum& rest = spectra.at_rest(plan);
    for (WaveView& view : reading.views) {
        view.phase = in_steps(rest, orientations, plan, view);
        for (std::size_t k = 0; k < view.phase.size(); ++k)
            view.phase[k] -= plan.dithers[k];
    }
    if (options.at_rest_only)
        return reading;

    const std::array<WaveSpectra::Spectrum, 2> flows = spectra.flows(plan);
    const std::vector<const WaveSpectra::Spectrum*> before = spectra.unsmoothed(plan);
    for (WaveView& view : reading.views) {
        view.bend = in_steps(flows[0], orientations, plan, view);
        view.relax = in_steps(flows[1], orientations, plan, view);
        to_half_a_period(view.bend);
        make_square(view.relax, view.bend);
        to_half_a_period(view.relax);
        std::vector<std::vector<double>> at_nodes;
        at_nodes.reserve(before.size());
        for (const WaveSpectra::Spectrum* spectrum : before)
            at_nodes.push_back(in_steps(*spectrum, orientations, plan, view));
        view.undone = interpolated(at_nodes, reading.grid->undone, plan.dithers);
    }
    return reading;
}

std::vector<double> wave_phases(const WaveReading& reading, const WaveWay& way)
{
    const WaveView& view = reading.views[way.view];
    std::vector<double> y = way.undone < 0 ? view.phase : view.undone[way.undone];
    for (std::size_t k = 0; k < view.bend.size(); ++k)
        y[k] += way.t * view.bend[k] + way.u * view.relax[k];
    return y;
}

} // namespace vcg_ext
