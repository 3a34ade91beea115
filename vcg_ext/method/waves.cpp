// SPDX-License-Identifier: GPL-3.0-or-later
#include "waves.h"

#include "wave_embedding.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace vcg_ext {

namespace {

constexpr int rungs_at_rest = 18;  ///< each way from the usual strength: a factor of 22, so 5e-6 to 2e-3
constexpr int rungs_processed = 6; ///< the same where processing is allowed for: 3.5e-5 to 2.8e-4
constexpr int rungs_of_many = 2;   ///< the same for more than
constexpr int many_waves = 128;    ///< waves, for the time it takes
constexpr int most_ways = 4;
constexpr double rest_share = 0.25; ///< of the doubt, for the reading at rest; the other has the rest
constexpr double sure = -9;         ///< log10 of presence: no need to look at what processing may have done

/// A reading and what it says by the key alone; shared by who asks about expected bits later.
struct Read {
    WaveReading reading;
    WavePresence presence;
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
    for (std::size_t i = 0; i < all.size(); ++i)
        best = std::min(best, log10_of(log_p(*all[i])) - std::log10(i == 0 ? rest_share : 1 - rest_share));
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
    const auto read = [&](bool at_rest_only, int rungs) {
        WaveReadOptions options;
        options.rungs = rungs;
        options.at_rest_only = at_rest_only;
        auto result = std::make_shared<Read>();
        result->reading = read_waves(spectra, plan.waves, options);
        result->presence = wave_presence(result->reading);
        return result;
    };
    std::vector<std::shared_ptr<const Read>> all{read(true, rungs_at_rest)};
    if (log10_of(all.front()->presence.log_p) > sure && !plan.options.quick)
        all.push_back(read(false, plan.options.bits <= many_waves ? rungs_processed : rungs_of_many));
    const Read& found = **std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
        return a->presence.log_evidence < b->presence.log_evidence; // neither looks at bits
    });
    Readings readings;
    readings.in_log_likelihoods = true;
    for (WaveSoft& way : wave_ways(found.reading, found.presence, most_ways)) {
        Reading reading;
        reading.weight = way.weight;
        reading.erased.assign(way.soft.size(), 0);
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
