// SPDX-License-Identifier: GPL-3.0-or-later
#include "trial.h"

#include "../payload/code.h"
#include "secrets.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace vcg_ext {

namespace {

constexpr int most_to_search = 256; ///< carriers that are read in full where their number is not known

/// Whether there is nothing that is too long for so many carriers alone.
bool one_fits(const std::vector<Message>& expected, int carriers)
{
    return expected.empty() || std::any_of(expected.begin(), expected.end(), [carriers](const Message& message) {
               return static_cast<int>(message.bits.size()) <= carriers;
           });
}

/// Half of the doubt is for the number that the expected message asks for, the rest for the other recommended ones.
/// \param share of the doubt, for all of them
std::vector<Count> counts_to_try(const DetectOptions& options, double share)
{
    if (options.carriers.bits > 0)
        return {{options.carriers.bits, share, options.carriers.quick}};
    std::vector<int> ladder = recommended_numbers();
    if (!options.expected.empty()) {
        const int own = recommended_carriers(options.expected.front());
        std::stable_partition(ladder.begin(), ladder.end(), [own](int count) { return count == own; });
    }
    std::vector<Count> counts;
    for (std::size_t i = 0; i < ladder.size(); ++i)
        counts.push_back({ladder[i], share * std::exp2(-static_cast<double>(std::min(i + 1, ladder.size() - 1))),
                          options.expected.empty() ? ladder[i] > most_to_search : i > 0});
    return counts;
}

/// What each layer of the method reads; those that cannot read this surface at all are left out, and say why.
std::vector<LayerReading> read_layers(const LayerReader& read, const Key& key, CarrierOptions options, double& trim,
                                      std::vector<std::string>& warnings)
{
    const MethodRow& wanted = row_of(options.method);
    std::vector<LayerReading> layers;
    std::string first_error;
    for (const auto& layer : wanted.layers) {
        const MethodRow& method = row_of(layer.first);
        options.method = layer.first;
        try {
            const Plan plan = method.plan(key, options);
            LayerReading one{layer.first, read(method, plan), bit_mask(key, method.secret, options.bits)};
            trim = std::max(trim, plan.trim);
            layers.push_back(std::move(one));
        } catch (const Cancelled&) {
            throw;
        } catch (const Error& error) {
            if (first_error.empty())
                first_error = error.what();
            if (wanted.layers.size() > 1)
                warnings.push_back(std::string(method.name) + " reads nothing here: " + error.what());
        }
    }
    if (layers.empty())
        throw Error(first_error);
    for (const LayerReading& layer : layers)
        warnings.insert(warnings.end(), layer.readings.warnings.begin(), layer.readings.warnings.end());
    return layers;
}

/// log10 p of the expected message, or of any.
double log10_p(const Trial& trial, bool expected)
{
    return trial.after_share(expected ? trial.judgement.match->log10_p : trial.judgement.best.log10_p);
}

/// log10 p that a mark is there, whatever its message.
double log10_presence(const Trial& trial)
{
    double least = 0;
    for (const LayerReading& layer : trial.layers)
        least = std::min(least, trial.after_share(layer.readings.presence.value_or(0)));
    return least;
}

/// Less says more: a message that is proven, by its p; short of that, a mark that is there.
double loudness(const Trial& trial)
{
    const double any = log10_p(trial, false);
    const double message = trial.judgement.match ? std::min(any, log10_p(trial, true)) : any;
    return message < log10_sure ? message : std::max(log10_sure, std::min(message, log10_presence(trial)));
}

Trial try_count(const LayerReader& read, const Key& key, const DetectOptions& options, const Count& count)
{
    Trial trial;
    trial.count = count;
    CarrierOptions carriers = options.carriers;
    carriers.bits = count.carriers;
    carriers.quick = count.quick;
    trial.layers = read_layers(read, key, carriers, trial.trim, trial.warnings);
    trial.judgement = judge(trial.layers, count.carriers, options.expected);
    return trial;
}

} // namespace

Search try_counts(const LayerReader& read, const Key& key, const DetectOptions& options, double share,
                  const Progress& progress)
{
    const std::vector<Count> counts = counts_to_try(options, share);
    std::optional<Trial> best;
    Search result;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        report(progress, 10 + 80 * static_cast<int>(i) / static_cast<int>(counts.size()), "Reading");
        if (!one_fits(options.expected, counts[i].carriers))
            continue;
        Trial trial = try_count(read, key, options, counts[i]);
        result.log10_any = std::min(result.log10_any, log10_p(trial, false));
        if (!options.expected.empty())
            result.log10_expected = std::min(result.log10_expected, log10_p(trial, true));
        if (!best || loudness(trial) < loudness(*best))
            best = std::move(trial);
        if (result.log10_any < log10_sure || result.log10_expected < log10_sure)
            break; // weights were fixed before looking, so to stop here is no choice
    }
    if (!best)
        throw Error("The expected message does not fit: " + need(options.expected.front()) + ", but Bits is " +
                    std::to_string(counts.front().carriers) + ". Bits must be that of embedding; 0 finds it.");
    result.best = std::move(*best);
    return result;
}

} // namespace vcg_ext
