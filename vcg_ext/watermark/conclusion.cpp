// SPDX-License-Identifier: GPL-3.0-or-later
#include "conclusion.h"

#include "../base/text.h"
#include "../payload/binomial.h"
#include "../payload/code.h"
#include "secrets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace vcg_ext {

namespace {

constexpr double doubtful = -2; ///< log10 of the probability above which a reading is not told from chance

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

std::string carries(const std::string& message, double log10_p)
{
    return "carries " + quoted(message) + " (" + chance(log10_p) + ")";
}

/// What a search comes to, and the same in words.
struct Said {
    Verdict finding;
    std::string words;
};

/// What is sure of a message, if anything is.
/// \param expected null where none is
/// \param same whether no other message than the expected one is verified
std::optional<Said> said_of_message(const Message* expected, bool same, const Search& search,
                                    const DetectReport& result)
{
    if (expected && *result.present)
        return Said{Verdict::Present, "present: the mesh " + carries(expected->text, search.log10_expected) + "."};
    if (!expected && result.verified)
        return Said{Verdict::Present, "present: the mesh " + carries(result.message, search.log10_any) + "."};
    if (!same)
        return Said{Verdict::AnotherMessage, "another message: " + carries(result.message, search.log10_any) +
                                                 ", not " + quoted(expected->text) + "."};
    return std::nullopt;
}

/// What shows of a mark whose message does not, if anything does.
std::optional<Said> said_of_carriers(const Trial& trial)
{
    for (const LayerReading& layer : trial.layers) {
        const double usual = row_of(layer.method).unmarked_strength;
        const double presence = trial.after_share(layer.readings.presence.value_or(0));
        if (presence < log10_sure)
            return Said{Verdict::NoMessage, std::string("no message: marked with this key by ") + name(layer.method) +
                                                " (" + chance(presence) + "), but no message is read for certain."};
        if (const double strength = mean_strength(layer); usual > 0 && strength > usual)
            return Said{Verdict::AnotherKey, std::string("another key or setting: the carriers of ") +
                                                 name(layer.method) + " are too strong for an unmarked mesh (" +
                                                 text(std::round(100 * strength) / 100) +
                                                 " standard errors, where up to " + text(usual) +
                                                 " is usual), but no message of this key is certain."};
    }
    return std::nullopt;
}

/// \param log10_p of whatever message reads best
Said said_of_nothing(double log10_p)
{
    return {Verdict::NotFound, log10_p < doubtful
                                   ? "not found: a message reads better than chance would have it (" + chance(log10_p) +
                                         "), but is not certain."
                                   : "not found: no mark of this key; the mesh is unmarked, or the mark is destroyed."};
}

/// Fills in what was found, and says it in words.
void give_verdict(const DetectOptions& options, const Search& search, DetectReport& result)
{
    const Judgement& judgement = search.best.judgement;
    const Message* expected = options.expected.empty() ? nullptr : &options.expected[judgement.match->candidate];
    result.p_message = probability(search.log10_any);
    result.verified = search.log10_any < log10_sure;
    if (result.verified)
        result.message = show_message(judgement.best.bits, judgement.best.kind);
    const bool same = !expected || expected->kind == Kind::Bits || !result.verified ||
                      trimmed(judgement.best.bits) == trimmed(expected->bits);
    if (expected) {
        result.p_value = probability(search.log10_expected);
        result.present = search.log10_expected < log10_sure && same;
    }
    std::optional<Said> said = said_of_message(expected, same, search, result);
    if (!said)
        said = said_of_carriers(search.best);
    if (!said)
        said = said_of_nothing(std::min(search.log10_any, search.log10_expected));
    result.finding = said->finding;
    result.verdict = said->words;
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

} // namespace

DetectReport conclude(const DetectOptions& options, const Search& search, const std::vector<int>& site_of_vertex)
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
    give_verdict(options, search, result);
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

} // namespace vcg_ext
