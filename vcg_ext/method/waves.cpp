// SPDX-License-Identifier: GPL-3.0-or-later
#include "waves.h"

#include "../carrier/wave_evidence.h"
#include "wave_embedding.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace vcg_ext {

namespace {

constexpr int most_ways = 4;
constexpr int many_waves = 128; ///< above it fewer strengths are tried, for the time it takes
constexpr double sure = -9;     ///< log10 of presence: no need for a further look

/// One look for a mark: the strengths that it tries, in rungs from the usual one, and its share of the doubt.
struct Look {
    bool at_rest; ///< processing is not allowed for
    double share; ///< all looks' are 1
    int lowest, highest;
    int lowest_of_many, highest_of_many;
};

/// Six rungs are a factor of 2.8; all that embedding takes are within 18, a factor of 22. Strong and weak marks that
/// were processed have looks of their own, after the usual ones, for the time it takes.
constexpr Look looks[] = {{true, 0.25, -18, 18, -18, 18},
                          {false, 0.55, -6, 6, -2, 2},
                          {false, 0.1, 7, 18, 3, 8},
                          {false, 0.1, -16, -7, -8, -3}};

/// A reading and what it says by the key alone; shared by who asks about expected bits later.
struct Read {
    WaveReading reading;
    WavePresence presence;
    double share; ///< of the doubt
};

double log10_of(double natural)
{
    return natural / std::log(10.0);
}

/// log10 of the least of the readings' probabilities, each over its share.
template <class LogP>
double best_of(const std::vector<std::shared_ptr<const Read>>& all, const LogP& log_p)
{
    double best = 0;
    for (const std::shared_ptr<const Read>& one : all)
        best = std::min(best, log10_of(log_p(*one)) - std::log10(one->share));
    return best;
}

} // namespace

Plan plan_waves(const Key& key, const CarrierOptions& options)
{
    Plan plan;
    plan.options = options;
    plan.waves = wave_plan(key, options.bits);
    return plan;
}

MarkFrame find_waves(const Surface& surface, const Plan& /*plan*/)
{
    return std::make_shared<WaveSpectra>(wave_body(surface));
}

Readings read_by_waves(const Surface& /*surface*/, const Plan& plan, const MarkFrame& frame)
{
    WaveSpectra& spectra = *std::get<std::shared_ptr<WaveSpectra>>(frame);
    const bool many = plan.options.bits > many_waves;
    std::vector<std::shared_ptr<const Read>> all;
    for (const Look& look : looks) {
        if (!all.empty() && (plan.options.quick || log10_of(all.back()->presence.log_p) <= sure))
            break;
        WaveReadOptions options;
        options.lowest_rung = many ? look.lowest_of_many : look.lowest;
        options.highest_rung = many ? look.highest_of_many : look.highest;
        options.at_rest_only = look.at_rest;
        auto result = std::make_shared<Read>();
        result->reading = read_waves(spectra, plan.waves, options);
        result->presence = wave_presence(result->reading);
        result->share = look.share;
        all.push_back(std::move(result));
    }
    const Read& found = **std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
        const auto weighed = [](const Read& one) { return one.presence.log_evidence + std::log(one.share); };
        return weighed(*a) < weighed(*b); // neither looks at bits
    });
    Readings readings;
    readings.in_log_likelihoods = true;
    for (WaveSoft& way : wave_ways(found.reading, found.presence, most_ways)) {
        Reading reading;
        reading.weight = way.weight;
        reading.soft = std::move(way.soft);
        readings.ways.push_back(std::move(reading));
    }
    readings.presence = best_of(all, [](const Read& one) { return one.presence.log_p; });
    // Where phases do not gather visibly, only the message tells which reading is the better one.
    readings.match = [all](const Bits& coded) {
        return best_of(all, [&](const Read& one) { return wave_match(one.reading, one.presence, coded).log_p; });
    };
    return readings;
}

Marking embed_by_waves(const Cover& cover, const Plan& plan, const Bits& coded, const PlacementOptions& options,
                       const Progress& progress)
{
    WaveEmbedding embedded = embed_waves(cover, plan.waves, coded, options.strength, rounded_to_float, progress);
    Marking marking;
    marking.capacity = most_carriers;
    marking.rounds = embedded.rounds;
    marking.kept.guarded_vertices = embedded.guarded;
    marking.kept.points = std::move(embedded.points);
    return marking;
}

} // namespace vcg_ext
