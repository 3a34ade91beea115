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
constexpr double doubtful = -2;     ///< above it a reading is not told from chance

/// How often carriers are counted, and what share of the doubt each count may use.
struct Count {
    int carriers;
    double weight;
    bool quick; ///< see CarrierOptions
};

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

    /// log10 of a bound, this count's share taken off: so it holds for whichever count is chosen after looking.
    [[nodiscard]] double after_share(double log10_p) const { return std::min(0.0, log10_p - std::log10(count.weight)); }

    /// log10 p of the expected message, or of any.
    [[nodiscard]] double log10_p(bool expected) const
    {
        return after_share(expected ? judgement.match->log10_p : judgement.best.log10_p);
    }

    /// log10 p of the better one.
    [[nodiscard]] double log10_best() const
    {
        return judgement.match ? std::min(log10_p(true), log10_p(false)) : log10_p(false);
    }

    /// log10 p that a mark is there, whatever its message.
    [[nodiscard]] double log10_presence() const
    {
        double least = 0;
        for (const LayerReading& layer : layers)
            least = std::min(least, after_share(layer.readings.presence.value_or(0)));
        return least;
    }

    /// Less says more: a message that is proven, by its p; short of that, a mark that is there.
    [[nodiscard]] double loudness() const
    {
        const double message = log10_best();
        return message < sure ? message : std::max(sure, std::min(message, log10_presence()));
    }
};

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

/// What all counts come to.
struct Search {
    Trial best;                ///< that says the most
    double log10_any = 0;      ///< that any message reads as well
    double log10_expected = 0; ///< that one of those expected does
};

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
        result.log10_any = std::min(result.log10_any, trial.log10_p(false));
        if (!options.expected.empty())
            result.log10_expected = std::min(result.log10_expected, trial.log10_p(true));
        if (!best || trial.loudness() < best->loudness())
            best = std::move(trial);
        if (result.log10_any < sure || result.log10_expected < sure)
            break; // weights were fixed before looking, so to stop here is no choice
    }
    if (!best)
        throw Error("The expected message does not fit: " + need(options.expected.front()) + ", but Bits is " +
                    std::to_string(counts.front().carriers) + ". Bits must be that of embedding; 0 finds it.");
    result.best = std::move(*best);
    return result;
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
void conclude(const DetectOptions& options, const Search& search, DetectReport& result)
{
    const auto& [trial, log10_any, log10_expected] = search;
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
        const double presence = trial.after_share(layer.readings.presence.value_or(0));
        if (presence < sure) {
            result.finding = Verdict::NoMessage;
            result.verdict = std::string("no message: marked with this key by ") + name(layer.method) + " (" +
                             chance(presence) + "), but no message is read for certain.";
            return;
        }
        if (usual > 0 && mean_strength(layer) > usual) {
            result.finding = Verdict::AnotherKey;
            result.verdict = std::string("another key or setting: the carriers of ") + name(layer.method) +
                             " are too strong for an unmarked mesh (" +
                             text(std::round(100 * mean_strength(layer)) / 100) + " standard errors, where up to " +
                             text(usual) + " is usual), but no message of this key is certain.";
            return;
        }
    }
    result.finding = Verdict::NotFound;
    const double least = asked ? std::min(log10_any, log10_expected) : log10_any;
    result.verdict =
        least < doubtful
            ? "not found: a message reads better than chance would have it (" + chance(least) + "), but is not certain."
            : "not found: no mark of this key; the mesh is unmarked, or the mark is destroyed.";
}

/// How the carriers match the expected message's, as the literature counts it. An erased carrier is no coin: it counts
/// a half in the ratio, and not at all in the bound.
void count_matches(const DetectOptions& options, const Trial& trial, double view_weight, DetectReport& result)
{
    const Judgement::Match& match = *trial.judgement.match;
    const Bits coded = encode(options.expected[match.candidate], result.carriers);
    int read = 0;
    int matches = 0;
    for (std::size_t i = 0; i < coded.size(); ++i)
        if (result.soft[i] != 0) {
            ++read;
            matches += static_cast<int>(coded[i] == result.bits[i]);
        }
    result.detection_ratio = (matches + 0.5 * (result.carriers - read)) / result.carriers;
    result.p_binomial = std::min(1.0, binomial_tail(read, matches) * static_cast<double>(options.expected.size()) /
                                          view_weight / trial.count.weight);
    if (options.expected.size() > 1) {
        result.candidate = static_cast<int>(match.candidate);
        result.runner_up_p = probability(trial.after_share(match.runner_up));
    }
}

/// What each layer said by itself.
void tell_layers(const DetectOptions& options, const Trial& trial, DetectReport& result)
{
    for (std::size_t i = 0; i < trial.layers.size(); ++i) {
        LayerReport one;
        one.method = trial.layers[i].method;
        one.p_message = probability(trial.after_share(trial.judgement.of_layer[i].log10_p));
        if (options.expected.size() == 1)
            one.p_value = probability(trial.after_share(trial.judgement.match_of_layer[i]));
        if (const auto& presence = trial.layers[i].readings.presence) {
            one.presence = probability(trial.after_share(*presence));
            result.presence = std::min(result.presence.value_or(1), *one.presence);
        }
        result.layers.push_back(one);
    }
}

DetectReport told(const DetectOptions& options, const Search& search, const std::vector<int>& site_of_vertex)
{
    const Trial& trial = search.best;
    const Judgement::View& view = trial.judgement.views[trial.judgement.view];
    const LayerReading& layer = trial.layers[view.layer];
    const Reading& way = layer.readings.ways[view.way];
    DetectReport result;
    result.method = options.carriers.method;
    result.statistic = options.carriers.statistic;
    result.carriers = trial.count.carriers;
    result.trim = trial.trim;
    result.soft = summed(view.soft, result.carriers);
    result.bits = hard_bits(result.soft);
    result.samples = way.samples;
    conclude(options, search, result);
    if (trial.judgement.match)
        count_matches(options, trial, view.weight, result);
    tell_layers(options, trial, result);
    result.smoothing_rounds = layer.readings.smoothing_rounds;
    result.orientation = way.orientation;
    result.carrier_of_vertex = carrier_of_vertex(layer.readings, way, site_of_vertex);
    for (const LayerReading& other : trial.layers)
        if (result.carrier_of_vertex.empty())
            result.carrier_of_vertex =
                carrier_of_vertex(other.readings, other.readings.ways[other.readings.blind], site_of_vertex);
    result.warnings = trial.warnings;
    return result;
}

} // namespace

DetectReport detect_by(const LayerReader& read, const std::vector<int>& site_of_vertex, double share, const Key& key,
                       const DetectOptions& options, const Progress& progress)
{
    options.carriers.check();
    Stopwatch watch;
    DetectReport result = told(options, try_counts(read, key, options, share, progress), site_of_vertex);
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
