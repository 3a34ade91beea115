// SPDX-License-Identifier: GPL-3.0-or-later
#include "waves.h"

#include "wave_embedding.h"

#include <cmath>
#include <memory>

namespace vcg_ext {

namespace {

constexpr int rungs = 9; ///< each way from the usual strength: a factor of 22, so 5e-6 to 2e-3
constexpr int most_ways = 4;
constexpr double sure = -9; ///< log10 of presence: no need to look at what processing may have done

/// A reading and what it says by the key alone; shared by who asks about expected bits later.
struct Read {
    WaveReading reading;
    WavePresence presence;
};

double log10_of(double natural)
{
    return natural / std::log(10.0);
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
    return wave_body(surface);
}

Readings read_by_waves(const Surface& /*surface*/, const Plan& plan, const MarkFrame& frame)
{
    const WaveBody& body = std::get<WaveBody>(frame);
    // What is read at rest is a part of all the ways, with the same weights: to stop there is no choice to be paid for.
    const auto read = [&](bool at_rest_only) {
        WaveReadOptions options;
        options.rungs = rungs;
        options.at_rest_only = at_rest_only;
        auto result = std::make_shared<Read>();
        result->reading = read_waves(body, plan.waves, options);
        result->presence = wave_presence(result->reading);
        return result;
    };
    std::shared_ptr<const Read> found = read(true);
    if (log10_of(found->presence.log_p) > sure)
        found = read(false);
    Readings readings;
    readings.in_log_likelihoods = true;
    for (WaveSoft& way : wave_ways(found->reading, found->presence, most_ways)) {
        Reading reading;
        reading.weight = way.weight;
        reading.erased.assign(way.soft.size(), 0);
        reading.soft = std::move(way.soft);
        readings.ways.push_back(std::move(reading));
    }
    readings.presence = log10_of(found->presence.log_p);
    readings.match = [found](const Bits& coded) {
        return log10_of(wave_match(found->reading, found->presence, coded).log_p);
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
