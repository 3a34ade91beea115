// SPDX-License-Identifier: GPL-3.0-or-later
#include "waves.h"

#include "wave_embedding.h"

#include <cmath>
#include <memory>

namespace vcg_ext {

namespace {

constexpr int rungs_at_rest = 9;   ///< each way from the usual strength: a factor of 22, so 5e-6 to 2e-3
constexpr int rungs_processed = 3; ///< the same where processing is allowed for: 3.5e-5 to 2.8e-4
constexpr int many_waves = 128;    ///< above it only the rungs next to the usual one, for the time it takes
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
    return std::make_shared<WaveSpectra>(wave_body(surface));
}

Readings read_by_waves(const Surface& /*surface*/, const Plan& plan, const MarkFrame& frame)
{
    WaveSpectra& spectra = *std::get<std::shared_ptr<WaveSpectra>>(frame);
    const auto read = [&](bool at_rest_only, int rungs) {
        WaveReadOptions options;
        options.rungs = rungs;
        options.at_rest_only = at_rest_only;
        auto result = std::make_shared<Read>();
        result->reading = read_waves(spectra, plan.waves, options);
        result->presence = wave_presence(result->reading);
        return result;
    };
    std::shared_ptr<const Read> found = read(true, rungs_at_rest);
    if (log10_of(found->presence.log_p) > sure && !plan.options.quick) {
        std::shared_ptr<const Read> processed = read(false, plan.options.bits <= many_waves ? rungs_processed : 1);
        if (processed->presence.log_p < found->presence.log_p)
            found = std::move(processed);
    }
    const double half = std::log10(2.0); // two readings, each with half of the doubt
    Readings readings;
    readings.in_log_likelihoods = true;
    for (WaveSoft& way : wave_ways(found->reading, found->presence, most_ways)) {
        Reading reading;
        reading.weight = way.weight;
        reading.erased.assign(way.soft.size(), 0);
        reading.soft = std::move(way.soft);
        readings.ways.push_back(std::move(reading));
    }
    readings.presence = std::min(0.0, log10_of(found->presence.log_p) + half);
    readings.match = [found, half](const Bits& coded) {
        return std::min(0.0, log10_of(wave_match(found->reading, found->presence, coded).log_p) + half);
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
