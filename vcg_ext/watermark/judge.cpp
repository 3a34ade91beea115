// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge.h"

#include "../payload/code.h"
#include "../payload/evidence.h"
#include "secrets.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace vcg_ext {

namespace {

/// log-likelihood ratios of soft values in standard errors.
std::vector<double> in_log_likelihoods(std::vector<double> soft)
{
    double square = 0;
    for (const double z : soft)
        square += z * z / static_cast<double>(soft.size());
    const double strength = 2 * std::sqrt(std::max(square - 1, 0.0));
    for (double& z : soft)
        z = std::clamp(strength * z, -20.0, 20.0);
    return soft;
}

/// The coded bits, once for each layer that the view holds.
Bits repeated(const Bits& coded, std::size_t length)
{
    Bits all = coded;
    while (all.size() < length)
        all.insert(all.end(), coded.begin(), coded.end());
    return all;
}

/// Codes by length and kind; making one takes longer than using it.
class Codes {
public:
    explicit Codes(int carriers) : carriers_(carriers) {}

    const Code& operator()(int bits, Kind kind)
    {
        const auto key = std::make_pair(bits, kind == Kind::Id);
        const auto found = codes_.find(key);
        return found != codes_.end() ? found->second : codes_.try_emplace(key, bits, carriers_, kind).first->second;
    }

    /// The coded bits of a message; of raw bits these themselves, filled up with zeros.
    Bits encode(const Message& message)
    {
        const int bits = static_cast<int>(message.bits.size());
        if (message.kind != Kind::Bits && bits <= carriers_)
            return (*this)(coded_length(bits, carriers_), message.kind).encode(message.bits);
        return vcg_ext::encode(message, carriers_);
    }

private:
    int carriers_;
    std::map<std::pair<int, bool>, Code> codes_;
};

/// Whether a message is likelier than that the carriers hold any other word. Of one layer alone its p tells; two layers
/// that agree on a word of another length, or on raw bits, prove the message whose word is the nearest, though it is not
/// theirs. \param soft log-likelihood ratios
bool explains(const Bits& coded, const std::vector<double>& soft, int bits)
{
    const double ln_2 = std::log(2.0);
    double gain = -bits * ln_2;
    for (std::size_t k = 0; k < soft.size(); ++k)
        gain += ln_2 - std::log1p(std::exp(coded[k] ? -soft[k] : soft[k]));
    return gain > 0;
}

/// log10 p that the signs agree so well with a coded word, which is repeated where there are more of them.
double log10_of_signs(const Bits& coded, const std::vector<double>& soft)
{
    return SignTail(soft).log10_p(agreement(repeated(coded, soft.size()), soft));
}

/// The best message of all lengths that a reader with the key alone tries, in one view as if there were no other.
Judgement::Read read(const Judgement::View& view, int carriers, Codes& codes)
{
    Judgement::Read best;
    const std::vector<double> soft = summed(view.soft, carriers);
    const SignTail tail(view.soft);
    double loudest = 0;
    for (const double value : view.soft)
        loudest += std::abs(value);
    for (const Hypothesis& way : hypotheses(carriers)) {
        const double share = std::log10(way.weight);
        if (log_any_message(tail.log10_p(loudest), way.bits) - share >= best.log10_p)
            continue; // not even if all signs were right
        const Code& code = codes(way.bits, way.kind);
        const Bits bits = code.decode(soft);
        const Bits coded = code.encode(bits);
        const double total = agreement(repeated(coded, view.soft.size()), view.soft);
        const double p = log_any_message(tail.log10_p(total), way.bits) - share;
        const bool alone = view.soft.size() == soft.size();
        if (p < best.log10_p && (alone || explains(coded, soft, way.bits)))
            best = {p, bits, way.kind};
    }
    return best;
}

/// How many kinds of views there are, each with the same share of the doubt: each layer alone, and each behind the first.
double kinds_of_views(const std::vector<LayerReading>& layers)
{
    return static_cast<double>(2 * layers.size() - 1);
}

/// What is judged: the layers, and what they come to so far.
class Judge {
public:
    Judge(const std::vector<LayerReading>& layers, int carriers)
        : layers_(layers), carriers_(carriers), kinds_(kinds_of_views(layers)), codes_(carriers)
    {
        result.views = views_of(layers);
    }

    /// Looks for any message, in the blind views. No mask had a part in their choice, so each has the weight of all ways.
    void read_blind()
    {
        result.of_layer.resize(layers_.size());
        result.view = std::find_if(result.views.begin(), result.views.end(),
                                   [](const Judgement::View& view) { return view.blind; }) -
                      result.views.begin();
        for (std::size_t v = 0; v < result.views.size(); ++v) {
            const Judgement::View& view = result.views[v];
            if (!view.blind)
                continue;
            Judgement::Read found = read(view, carriers_, codes_);
            if (is_alone(view))
                result.of_layer[view.layer] = found;
            found.log10_p += std::log10(kinds_);
            if (found.log10_p < result.best.log10_p) {
                result.best = std::move(found);
                result.view = v;
            }
        }
    }

    /// Looks for one message, in all views. Beside another message two layers are no two witnesses: both carry it, so they
    /// agree in what they say of this one. In its p a bit of two layers is therefore one coin, as heavy as their sum; how
    /// loud a view is, which is to be shown, both say.
    void match_one(const Message& expected)
    {
        const Bits coded = codes_.encode(expected);
        result.match_of_layer.assign(layers_.size(), 0);
        double best = 0;
        Loudest loudest{0, result.view};
        for (std::size_t v = 0; v < result.views.size(); ++v) {
            const Judgement::View& view = result.views[v];
            const auto& knows_better = layers_[view.layer].readings.match;
            if (is_alone(view) && knows_better && !view.blind)
                continue; // it is asked once, for all ways
            double log10_p = is_alone(view) && knows_better
                                 ? knows_better(masked(coded, layers_[view.layer].mask)) + std::log10(kinds_)
                                 : log10_of_signs(coded, view.soft) - std::log10(view.weight);
            loudest = std::min(loudest, Loudest{log10_p, v});
            if (is_alone(view)) {
                double& of_layer = result.match_of_layer[view.layer];
                of_layer = std::min(of_layer, by_itself(log10_p));
            } else {
                log10_p = log10_of_signs(coded, summed(view.soft, carriers_)) - std::log10(view.weight);
            }
            best = std::min(best, log10_p);
        }
        conclude({0, best, 0}, loudest);
    }

    /// Looks for each of a list, in the blind views, and by the count alone: the bound of Chernoff costs a search for
    /// each. Who asks whose message it is holds against each that it is another's.
    void match_list(const std::vector<Message>& expected)
    {
        struct Coins {
            std::size_t view;
            std::vector<double> soft; ///< one a bit
            SignTail tail;            ///< of these
        };
        std::vector<Coins> blind;
        for (std::size_t v = 0; v < result.views.size(); ++v)
            if (const Judgement::View& view = result.views[v]; view.blind) {
                const std::vector<double> soft = summed(view.soft, carriers_);
                blind.push_back({v, soft, SignTail(soft)});
            }
        constexpr double even = 2; // words differ in an even number of bits, so what is near is up to twice as likely
        const double many = std::log10(even * kinds_ * static_cast<double>(expected.size()));
        result.match_of_layer.assign(layers_.size(), 0);
        Judgement::Match match;
        double best = 1;
        Bits best_coded;
        std::size_t at_best = result.view;
        for (std::size_t c = 0; c < expected.size(); ++c) {
            if (static_cast<int>(expected[c].bits.size()) > carriers_)
                continue; // no such mesh can hold it; it counts all the same
            const Bits coded = codes_.encode(expected[c]);
            if (coded == best_coded)
                continue; // the same line again is no runner-up
            double p = 0;
            std::size_t at = result.view;
            for (const Coins& coins : blind)
                if (const double here = coins.tail.log10_count(agreement(coded, coins.soft)); here < p) {
                    p = here;
                    at = coins.view;
                }
            if (p < best) {
                match.runner_up = std::min(0.0, best + many);
                best = p;
                best_coded = coded;
                match.candidate = c;
                at_best = at;
            } else {
                match.runner_up = std::min(match.runner_up, p + many);
            }
        }
        match.log10_p = std::min(0.0, best + many);
        conclude(match, {match.log10_p, at_best});
    }

    Judgement result;

private:
    using Loudest = std::pair<double, std::size_t>; ///< log10 of a probability, and the view that it is of

    [[nodiscard]] bool is_alone(const Judgement::View& view) const
    {
        return static_cast<int>(view.soft.size()) == carriers_;
    }

    /// log10 p of a layer without the share that all views of all layers have. \param log10_p with it, not cut off at 0
    [[nodiscard]] double by_itself(double log10_p) const { return std::min(0.0, log10_p - std::log10(kinds_)); }

    void conclude(const Judgement::Match& match, Loudest loudest)
    {
        result.match = match;
        if (loudest.first < result.best.log10_p)
            result.view = loudest.second;
    }

    const std::vector<LayerReading>& layers_;
    int carriers_;
    double kinds_;
    Codes codes_;
};

} // namespace

std::vector<Judgement::View> views_of(const std::vector<LayerReading>& layers)
{
    const double shares = kinds_of_views(layers);
    std::vector<Judgement::View> views;
    const auto soft_of = [&](std::size_t layer, std::size_t way, bool likelihoods) {
        const LayerReading& read = layers[layer];
        std::vector<double> soft = unmasked(read.readings.ways[way].soft, read.mask);
        return likelihoods && !read.readings.in_log_likelihoods ? in_log_likelihoods(std::move(soft)) : soft;
    };
    for (std::size_t layer = 0; layer < layers.size(); ++layer) {
        const Readings& readings = layers[layer].readings;
        for (std::size_t way = 0; way < readings.ways.size(); ++way) {
            const bool blind = static_cast<int>(way) == readings.blind;
            const double weight = readings.ways[way].weight / shares;
            views.push_back(
                {weight, static_cast<int>(layer), static_cast<int>(way), blind, soft_of(layer, way, false)});
            if (layer == 0)
                continue;
            std::vector<double> both = soft_of(0, layers[0].readings.blind, true);
            const std::vector<double> own = soft_of(layer, way, true);
            both.insert(both.end(), own.begin(), own.end());
            views.push_back({weight, static_cast<int>(layer), static_cast<int>(way), blind, std::move(both)});
        }
    }
    return views;
}

std::vector<double> summed(const std::vector<double>& soft, int carriers)
{
    std::vector<double> sum(soft.begin(), soft.begin() + carriers);
    for (std::size_t i = carriers; i < soft.size(); ++i)
        sum[i % carriers] += soft[i];
    return sum;
}

Judgement judge(const std::vector<LayerReading>& layers, int carriers, const std::vector<Message>& expected)
{
    Judge judge(layers, carriers);
    judge.read_blind();
    if (expected.size() == 1)
        judge.match_one(expected.front());
    else if (!expected.empty())
        judge.match_list(expected);
    return std::move(judge.result);
}

} // namespace vcg_ext
