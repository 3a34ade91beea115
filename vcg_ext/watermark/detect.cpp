// SPDX-License-Identifier: GPL-3.0-or-later
#include "detect.h"

#include "../base/stopwatch.h"
#include "../base/text.h"
#include "../geometry/body.h"
#include "../method/methods.h"
#include "../payload/binomial.h"
#include "../payload/code.h"
#include "../payload/evidence.h"
#include "judge.h"
#include "pieces.h"
#include "secrets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace vcg_ext {

namespace {

constexpr int most_to_search = 256; ///< carriers that are read in full where their number is not known
constexpr double sure = -6;         ///< log10 of the probability below which a finding is told as one

/// How often carriers are counted, and what share of the doubt each count may use.
struct Count {
    int carriers;
    double weight;
    bool quick; ///< see CarrierOptions
};

/// Half of the doubt is for the number that the expected message asks for, the rest for the other recommended ones.
std::vector<Count> counts_to_try(const DetectOptions& options)
{
    if (options.carriers.bits > 0)
        return {{options.carriers.bits, 1, options.carriers.quick}};
    std::vector<int> ladder = recommended_numbers();
    if (!options.expected.empty()) {
        const int own = recommended_carriers(options.expected.front());
        std::stable_partition(ladder.begin(), ladder.end(), [own](int count) { return count == own; });
    }
    std::vector<Count> counts;
    for (std::size_t i = 0; i < ladder.size(); ++i)
        counts.push_back({ladder[i], std::exp2(-static_cast<double>(std::min(i + 1, ladder.size() - 1))),
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

/// Per vertex of the unwelded surface the number of the carrier that it is in, or -1; empty where carriers are no sets
/// of vertices.
std::vector<int> carrier_of_vertex(const Readings& readings, const Reading& way, const std::vector<int>& site_of_vertex)
{
    if (readings.label_of_vertex.empty())
        return {};
    std::vector<int> carrier_of_label;
    for (std::size_t i = 0; i < way.label.size(); ++i)
        if (way.label[i] >= 0) {
            if (way.label[i] >= static_cast<int>(carrier_of_label.size()))
                carrier_of_label.resize(way.label[i] + 1, -1);
            carrier_of_label[way.label[i]] = static_cast<int>(i);
        }
    std::vector<int> result(site_of_vertex.size(), -1);
    for (std::size_t v = 0; v < result.size(); ++v) {
        const int label = site_of_vertex[v] >= 0 ? readings.label_of_vertex[site_of_vertex[v]] : -1;
        if (label >= 0 && label < static_cast<int>(carrier_of_label.size()))
            result[v] = carrier_of_label[label];
    }
    return result;
}

/// Mean |z| of soft values in standard errors: some .8 on an unmarked mesh, and above 1.2 where any key's mark is.
double mean_strength(const LayerReading& layer)
{
    const std::vector<double>& soft = layer.readings.ways[layer.readings.blind].soft;
    double sum = 0;
    for (const double z : soft)
        sum += std::abs(z) / static_cast<double>(soft.size());
    return sum;
}

/// Never 0, which would be no bound.
double probability(double log10_p)
{
    return std::max(std::pow(10.0, log10_p), std::numeric_limits<double>::min());
}

/// All of one count of carriers that is worth comparing with others.
struct Trial {
    Count count{};
    std::vector<LayerReading> layers;
    Judgement judgement;
    double trim = 0;
    std::vector<std::string> warnings;

    /// log10 p of the expected message, or of any, this count's share taken off.
    [[nodiscard]] double log10_p(bool expected) const
    {
        const double p = expected ? judgement.match->log10_p : judgement.best.log10_p;
        return std::min(0.0, p - std::log10(count.weight));
    }
};

/// Whether there is nothing that is too long for so many carriers alone.
bool one_fits(const std::vector<Message>& expected, int carriers)
{
    return expected.empty() || std::any_of(expected.begin(), expected.end(), [carriers](const Message& message) {
               return static_cast<int>(message.bits.size()) <= carriers;
           });
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

/// Without the zeros that a message is filled up with.
Bits trimmed(Bits bits)
{
    while (!bits.empty() && bits.back() == 0)
        bits.pop_back();
    return bits;
}

std::string quoted(const std::string& message)
{
    return "'" + message + "'";
}

/// Fills in what was found, and says it in words.
void conclude(const DetectOptions& options, const Trial& trial, double log10_any, double log10_expected,
              DetectReport& result)
{
    const Judgement& judgement = trial.judgement;
    const bool asked = !options.expected.empty();
    const Message* expected = asked ? &options.expected[judgement.match->candidate] : nullptr;
    const bool raw = asked && expected->kind == Kind::Bits;
    result.p_message = probability(log10_any);
    result.verified = log10_any < sure;
    if (result.verified)
        result.message = show_message(judgement.best.bits, judgement.best.kind);
    if (asked) {
        const bool same = raw || !result.verified || trimmed(judgement.best.bits) == trimmed(expected->bits);
        result.p_value = probability(log10_expected);
        result.present = log10_expected < sure && same;
        const std::string wanted = quoted(expected->text);
        if (*result.present) {
            result.finding = Verdict::Present;
            result.verdict = "present: the mesh carries " + wanted + " (" + chance(log10_expected) + ").";
            return;
        }
        if (result.verified && !same) {
            result.finding = Verdict::AnotherMessage;
            result.verdict = "another message: carries " + quoted(result.message) + " (" + chance(log10_any) +
                             "), not " + wanted + ".";
            return;
        }
    } else if (result.verified) {
        result.finding = Verdict::Present;
        result.verdict = "present: the mesh carries " + quoted(result.message) + " (" + chance(log10_any) + ").";
        return;
    }
    for (const LayerReading& layer : trial.layers) {
        const double usual = row_of(layer.method).unmarked_strength;
        if (layer.readings.presence && *layer.readings.presence < sure) {
            result.finding = Verdict::AnotherKey;
            result.verdict = std::string("marked with this key by ") + name(layer.method) + " (" +
                             chance(*layer.readings.presence) + "), but no message is read for certain.";
            return;
        }
        if (usual > 0 && mean_strength(layer) > usual) {
            result.finding = Verdict::AnotherKey;
            result.verdict = std::string("another key or setting: the carriers of ") + name(layer.method) +
                             " are too strong for an unmarked mesh (" + text(mean_strength(layer)) +
                             " standard errors, where up to " + text(usual) +
                             " is usual), but hold no message of this key.";
            return;
        }
    }
    result.finding = Verdict::NotFound;
    result.verdict = "not found: no mark of this key; the mesh is unmarked, or the mark is destroyed.";
}

} // namespace

const char* name(Verdict verdict)
{
    constexpr const char* names[] = {"not found", "present", "another message", "another key or setting"};
    return names[static_cast<int>(verdict)];
}

DetectReport detect_by(const LayerReader& read, const std::vector<int>& site_of_vertex, double share, const Key& key,
                       const DetectOptions& options, const Progress& progress)
{
    options.carriers.check();
    Stopwatch watch;
    const bool asked = !options.expected.empty();
    std::vector<Count> counts = counts_to_try(options);
    for (Count& count : counts)
        count.weight *= share;
    if (std::none_of(counts.begin(), counts.end(),
                     [&](const Count& count) { return one_fits(options.expected, count.carriers); }))
        throw Error("The expected message does not fit: " + need(options.expected.front()) + ", but Bits is " +
                    std::to_string(counts.front().carriers) + ". Bits must be that of embedding; 0 finds it.");

    std::optional<Trial> best;
    double log10_any = 0;
    double log10_expected = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        report(progress, 10 + 80 * static_cast<int>(i) / static_cast<int>(counts.size()), "Reading");
        if (!one_fits(options.expected, counts[i].carriers))
            continue;
        Trial trial = try_count(read, key, options, counts[i]);
        log10_any = std::min(log10_any, trial.log10_p(false));
        if (asked)
            log10_expected = std::min(log10_expected, trial.log10_p(true));
        const auto loudness = [asked](const Trial& t) {
            return asked ? std::min(t.log10_p(true), t.log10_p(false)) : t.log10_p(false);
        };
        if (!best || loudness(trial) < loudness(*best))
            best = std::move(trial);
        if (log10_any < sure || log10_expected < sure)
            break; // weights were fixed before looking, so to stop here is no choice
    }

    const Judgement& judgement = best->judgement;
    const Judgement::View& view = judgement.views[judgement.view];
    const LayerReading& layer = best->layers[view.layer];
    const Reading& way = layer.readings.ways[view.way];
    DetectReport result;
    result.method = options.carriers.method;
    result.statistic = options.carriers.statistic;
    result.carriers = best->count.carriers;
    result.trim = best->trim;
    result.soft.assign(view.soft.begin(), view.soft.begin() + result.carriers);
    for (std::size_t i = result.carriers; i < view.soft.size(); ++i)
        result.soft[i % result.carriers] += view.soft[i];
    result.bits = hard_bits(result.soft);
    result.samples = way.samples;
    conclude(options, *best, log10_any, log10_expected, result);
    if (asked) {
        const Bits coded = encode(options.expected[judgement.match->candidate], result.carriers);
        const int matches = matching_bits(coded, result.bits);
        result.detection_ratio = static_cast<double>(matches) / result.carriers;
        result.p_binomial =
            std::min(1.0, binomial_tail(result.carriers, matches) * static_cast<double>(options.expected.size()) /
                              view.weight / best->count.weight);
        if (options.expected.size() > 1) {
            result.candidate = static_cast<int>(judgement.match->candidate);
            result.runner_up_p = probability(judgement.match->runner_up);
        }
    }
    for (std::size_t i = 0; i < best->layers.size(); ++i) {
        LayerReport one;
        one.method = best->layers[i].method;
        one.p_message = probability(judgement.of_layer[i].log10_p);
        if (options.expected.size() == 1)
            one.p_value = probability(judgement.match_of_layer[i]);
        if (const auto& presence = best->layers[i].readings.presence) {
            one.presence = probability(*presence);
            result.presence = std::min(result.presence.value_or(1), *one.presence / best->count.weight);
        }
        result.layers.push_back(one);
    }
    result.smoothing_rounds = layer.readings.smoothing_rounds;
    result.orientation = way.orientation;
    result.carrier_of_vertex = carrier_of_vertex(layer.readings, way, site_of_vertex);
    for (const LayerReading& other : best->layers)
        if (result.carrier_of_vertex.empty())
            result.carrier_of_vertex =
                carrier_of_vertex(other.readings, other.readings.ways[other.readings.blind], site_of_vertex);
    result.warnings = best->warnings;
    result.seconds["detection"] = watch.lap();
    report(progress, 100, "Done");
    return result;
}

namespace {

/// \param body of the surface that is read
DetectReport detect_body(const Body& body, const Key& key, const DetectOptions& options, double share,
                         const Progress& progress)
{
    std::map<Method, MarkFrame> frames; // found once, whatever number of carriers is tried
    const LayerReader read = [&](const MethodRow& method, const Plan& plan) {
        if (frames.find(method.method) == frames.end())
            frames.emplace(method.method, method.find_frame(body.surface, plan));
        return method.read(body.surface, plan, frames.at(method.method));
    };
    return detect_by(read, body.site_of_vertex, share, key, options, progress);
}

/// Says of what pieces the body consists.
void tell_pieces(const Body& body, DetectReport& result)
{
    result.pieces = body.pieces;
    result.loose_pieces = body.loose_pieces;
    if (const std::string loose = about_loose_pieces(body); !loose.empty())
        result.warnings.push_back(loose);
}

} // namespace

DetectReport detect_whole(Surface surface, const Key& key, const DetectOptions& options, double share,
                          const Progress& progress)
{
    options.carriers.check();
    Stopwatch watch;
    report(progress, 0, "Finding carriers");
    DetectReport result =
        detect_whole(body_for(row_of(options.carriers.method), std::move(surface)), key, options, share, progress);
    result.seconds["detection"] = watch.lap();
    return result;
}

DetectReport detect_whole(const Body& body, const Key& key, const DetectOptions& options, double share,
                          const Progress& progress)
{
    DetectReport result = detect_body(body, key, options, share, progress);
    tell_pieces(body, result);
    return result;
}

DetectReport detect(Surface surface, const Key& key, const DetectOptions& options, const Progress& progress)
{
    options.carriers.check();
    Stopwatch watch;
    report(progress, 0, "Finding carriers");
    const Body body = body_for(row_of(options.carriers.method), std::move(surface));
    const std::vector<Part> pieces =
        body.pieces - body.loose_pieces > 1 ? pieces_to_look_at(body.surface) : std::vector<Part>();
    DetectReport result =
        detect_body(body, key, options, share_of_whole(pieces), within(progress, 0, pieces.empty() ? 100 : 30));
    const PieceReader read = [&](const Surface& piece, double share, const Progress& quietly) {
        return detect_whole(piece, key, options, share, quietly);
    };
    if (!pieces.empty() && result.finding != Verdict::Present)
        look_at_pieces(read, pieces, result, within(progress, 30, 100));
    tell_pieces(body, result);
    result.seconds["detection"] = watch.lap();
    report(progress, 100, "Done");
    return result;
}

} // namespace vcg_ext
