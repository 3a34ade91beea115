// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge.h"

#include "../payload/code.h"
#include "../payload/evidence.h"
#include "secrets.h"

#include <algorithm>
#include <cmath>
#include <map>

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

/// The soft value of each coded bit: the sum over the layers that the view holds.
std::vector<double> summed(const std::vector<double>& soft, int carriers)
{
    std::vector<double> sum(soft.begin(), soft.begin() + carriers);
    for (std::size_t i = carriers; i < soft.size(); ++i)
        sum[i % carriers] += soft[i];
    return sum;
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

/// The best message of all lengths that a reader with the key alone tries.
Judgement::Read read(const Judgement::View& view, int carriers, Codes& codes)
{
    Judgement::Read best;
    const std::vector<double> soft = summed(view.soft, carriers);
    const SignTail tail(view.soft);
    double loudest = 0;
    for (const double value : view.soft)
        loudest += std::abs(value);
    for (const Hypothesis& way : hypotheses(carriers)) {
        const double share = std::log10(way.weight * view.weight);
        if (log_any_message(tail.log10_p(loudest), way.bits) - share >= best.log10_p)
            continue; // not even if all signs were right
        const Code& code = codes(way.bits, way.kind);
        const Bits bits = code.decode(soft);
        const Bits coded = repeated(code.encode(bits), view.soft.size());
        const double p = log_any_message(tail.log10_p(agreement(coded, view.soft)), way.bits) - share;
        if (p < best.log10_p)
            best = {p, bits, way.kind};
    }
    return best;
}

} // namespace

std::vector<Judgement::View> views_of(const std::vector<LayerReading>& layers)
{
    const double shares = static_cast<double>(2 * layers.size() - 1);
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

Judgement judge(const std::vector<LayerReading>& layers, int carriers, const std::vector<Message>& expected)
{
    Judgement result;
    result.views = views_of(layers);
    const double shares = static_cast<double>(2 * layers.size() - 1);
    const double own_share = std::log10(1 / shares);
    Codes codes(carriers);
    result.view =
        std::find_if(result.views.begin(), result.views.end(), [](const Judgement::View& view) { return view.blind; }) -
        result.views.begin();

    result.of_layer.resize(layers.size());
    std::vector<std::size_t> view_of_layer(layers.size()); // the blind one of this layer alone
    for (std::size_t v = 0; v < result.views.size(); ++v) {
        Judgement::View view = result.views[v];
        if (!view.blind)
            continue;
        view.weight = 1 / shares; // no mask had a part in the choice of a blind way, so it has the weight of all
        Judgement::Read found = read(view, carriers, codes);
        const bool alone = static_cast<int>(view.soft.size()) == carriers;
        if (alone) {
            view_of_layer[view.layer] = v;
            result.of_layer[view.layer] = {std::min(0.0, found.log10_p + own_share), found.bits, found.kind};
        }
        if (found.log10_p < result.best.log10_p) {
            result.best = std::move(found);
            result.view = v;
        }
    }
    if (expected.empty())
        return result;

    const double count = static_cast<double>(expected.size());
    const double many = std::log10(count);
    std::vector<SignTail> tails;
    for (const Judgement::View& view : result.views)
        tails.emplace_back(view.soft);
    Judgement::Match match;
    match.log10_p = match.runner_up = 0;
    double best = 1;
    Bits best_coded;
    result.match_of_layer.assign(layers.size(), 0);
    std::size_t loudest = result.view;
    for (std::size_t c = 0; c < expected.size(); ++c) {
        if (static_cast<int>(expected[c].bits.size()) > carriers)
            continue; // no such mesh can hold it; it counts all the same
        const Bits coded = codes.encode(expected[c]);
        if (coded == best_coded)
            continue; // the same line again is no runner-up
        double p = 0;
        std::size_t at = 0;
        for (std::size_t v = 0; v < result.views.size(); ++v) {
            const Judgement::View& view = result.views[v];
            const bool alone = static_cast<int>(view.soft.size()) == carriers;
            if (expected.size() > 1 ? !view.blind : alone && layers[view.layer].readings.match)
                continue; // its method knows better
            const double total = agreement(repeated(coded, view.soft.size()), view.soft);
            // For a list the count alone: the bound of Chernoff costs a search for each.
            const double weight = expected.size() > 1 ? 1 / shares : view.weight;
            const double here =
                (expected.size() > 1 ? tails[v].log10_count(total) : tails[v].log10_p(total)) - std::log10(weight);
            if (here < p) {
                p = here;
                at = v;
            }
            if (expected.size() == 1 && alone)
                result.match_of_layer[view.layer] = std::min(result.match_of_layer[view.layer], here + own_share);
        }
        if (expected.size() == 1)
            for (std::size_t layer = 0; layer < layers.size(); ++layer)
                if (layers[layer].readings.match) {
                    const double here = layers[layer].readings.match(masked(coded, layers[layer].mask));
                    result.match_of_layer[layer] = std::min(result.match_of_layer[layer], here);
                    if (here - own_share < p) {
                        p = here - own_share;
                        at = view_of_layer[layer];
                    }
                }
        if (p < best) {
            match.runner_up = std::min(0.0, best + many);
            best = p;
            best_coded = coded;
            match.candidate = c;
            loudest = at;
        } else {
            match.runner_up = std::min(match.runner_up, p + many);
        }
    }
    match.log10_p = std::min(0.0, best + many);
    result.match = match;
    if (match.log10_p < result.best.log10_p)
        result.view = loudest;
    return result;
}

} // namespace vcg_ext
