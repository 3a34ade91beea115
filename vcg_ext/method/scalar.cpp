// SPDX-License-Identifier: GPL-3.0-or-later
#include "scalar.h"

#include "../base/parallel.h"
#include "../placement/histogram.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace vcg_ext {

namespace {

/// A carrier this far out, as a part of alpha, is strong enough; nearer ones are pushed again.
constexpr double enough = 0.75;

/// Part of a carrier that rounding to float can move a value by, with room to spare.
double float_guard(const Points& points, const Carriers& carriers)
{
    const double largest =
        ordered_maximum(static_cast<int>(points.size()), 0.0, [&](int v) { return points[v].cwiseAbs().maxCoeff(); });
    return 4 * std::numeric_limits<float>::epsilon() * largest / carriers.width;
}

/// \param read per carrier what its `count` samples say; a carrier without any says nothing
Readings readings_of(Carriers carriers, const std::vector<double>& read, const std::vector<int>& count,
                     const Plan& plan)
{
    const Statistic statistic = plan.options.statistic;
    Reading reading;
    for (const int k : plan.order) {
        reading.soft.push_back(count[k] > 0 ? (read[k] - threshold(statistic)) / standard_error(statistic, count[k])
                                            : 0);
        reading.samples.push_back(count[k]);
        reading.label.push_back(k);
    }
    Readings readings;
    readings.ways.push_back(std::move(reading));
    readings.label_of_vertex = std::move(carriers.label);
    return readings;
}

} // namespace

Readings read_carriers(Carriers carriers, const Plan& plan)
{
    const std::vector<int> count = samples(carriers);
    const std::vector<double> read = statistics(carriers, plan.options.statistic);
    return readings_of(std::move(carriers), read, count, plan);
}

Readings read_part(Carriers part, const Carriers& original, const std::vector<char>& left, const Plan& plan)
{
    const Statistic statistic = plan.options.statistic;
    Carriers rest = original;
    for (std::size_t v = 0; v < rest.label.size(); ++v)
        if (!left[v])
            rest.label[v] = -1;
    std::vector<int> count = samples(part);
    const std::vector<int> of_rest = samples(rest);
    std::vector<double> read = statistics(part, statistic);
    const std::vector<double> whole = statistics(original, statistic);
    const std::vector<double> same_part = statistics(rest, statistic);
    for (std::size_t k = 0; k < read.size(); ++k) {
        read[k] += whole[k] - same_part[k];
        if (of_rest[k] == 0)
            count[k] = 0;
    }
    return readings_of(std::move(part), read, count, plan);
}

TargetScalars::TargetScalars(const Carriers& cover, std::vector<double> mobility, const std::vector<char>& bits,
                             Statistic statistic, double guard)
    : cover_(cover), mobility_(std::move(mobility)), bits_(bits), statistic_(statistic), guard_(guard),
      now_(statistics(cover, statistic)), first_(cover.count + 1, 0), asked_(cover.count, NAN),
      scalars_(cover.label.size(), NAN)
{
    const std::vector<int> held = samples(cover);
    std::partial_sum(held.begin(), held.end(), first_.begin() + 1);
    vertices_.resize(first_.back());
    std::vector<int> next = first_;
    for (std::size_t v = 0; v < cover.label.size(); ++v)
        if (cover.label[v] >= 0)
            vertices_[next[cover.label[v]]++] = static_cast<int>(v);
}

const std::vector<double>& TargetScalars::at(const std::vector<double>& targets)
{
    for_chunks(cover_.count, 1, [&](int k, int) {
        if (targets[k] == asked_[k])
            return;
        asked_[k] = targets[k];
        if ((bits_[k] ? 1 : -1) * (now_[k] - targets[k]) < 0)
            map(k, targets[k]);
    });
    return scalars_;
}

void TargetScalars::map(int k, double target)
{
    std::vector<double> values;
    std::vector<double> mobilities;
    values.reserve(first_[k + 1] - first_[k]);
    mobilities.reserve(first_[k + 1] - first_[k]);
    for (int i = first_[k]; i < first_[k + 1]; ++i) {
        values.push_back(cover_.value[vertices_[i]]);
        mobilities.push_back(mobility_[vertices_[i]]);
    }
    const std::vector<double> mapped = map_histogram(values, statistic_, target, guard_, mobilities);
    for (std::size_t i = 0; i < mapped.size(); ++i)
        if (mobilities[i] > 0)
            scalars_[vertices_[first_[k] + i]] = cover_.scalar(k, mapped[i]);
}

CarrierTargets::CarrierTargets(const Bits& coded, const Plan& plan, double alpha)
    : bits_(coded.size()), statistic_(plan.options.statistic), alpha_(alpha), targets_(coded.size()),
      pushed_(coded.size(), 0), last_(coded.size(), 0)
{
    for (std::size_t i = 0; i < coded.size(); ++i)
        bits_[plan.order[i]] = static_cast<char>(coded[i]);
    for (std::size_t k = 0; k < targets_.size(); ++k)
        targets_[k] = threshold(statistic_) + side(k) * alpha;
}

std::vector<double> CarrierTargets::margins(const Carriers& read) const
{
    const double middle = threshold(statistic_);
    std::vector<double> margins = statistics(read, statistic_);
    for (std::size_t k = 0; k < margins.size(); ++k)
        margins[k] = side(k) * (margins[k] - middle) - enough * alpha_;
    return margins;
}

void CarrierTargets::push(const std::vector<double>& margins)
{
    for (std::size_t k = 0; k < targets_.size(); ++k) {
        const double share = pushed_[k] > 0 ? std::clamp((margins[k] - last_[k]) / pushed_[k], 0.25, 1.0) : 1;
        const double missing = margins[k] < 0 ? (1 - enough) * alpha_ - margins[k] : 0;
        const double target = std::clamp(targets_[k] + side(k) * missing / share, 0.02, 0.98);
        pushed_[k] = std::abs(target - std::exchange(targets_[k], target));
    }
    last_ = margins;
}

std::ptrdiff_t CarrierTargets::wrong(const std::vector<double>& margins) const
{
    return std::count_if(margins.begin(), margins.end(), [this](double margin) { return margin <= -enough * alpha_; });
}

int count_of_filled(int count, const std::function<Carriers(int)>& cut)
{
    const auto none_empty = [&](int carriers) {
        const std::vector<int> held = samples(cut(carriers));
        return std::find(held.begin(), held.end(), 0) == held.end();
    };
    int filled = count;
    while (filled < most_carriers && none_empty(std::min(2 * filled, most_carriers)))
        filled = std::min(2 * filled, most_carriers);
    for (int empty = std::min(2 * filled, most_carriers); filled < most_carriers && empty - filled > 1;) {
        const int middle = (filled + empty) / 2;
        (none_empty(middle) ? filled : empty) = middle;
    }
    return filled;
}

int checked_samples(const Carriers& carriers, const std::function<Carriers(int)>& cut)
{
    const std::vector<int> held = samples(carriers);
    if (const auto empty = std::count(held.begin(), held.end(), 0); empty > 0)
        throw DoesNotFit(std::to_string(empty) + " of the " + std::to_string(held.size()) + " carriers hold no vertex.",
                         count_of_filled(1, cut));
    return *std::min_element(held.begin(), held.end());
}

Storing storing(const Points& points, const Carriers& carriers, Storage storage)
{
    const double guard = float_guard(points, carriers);
    if (guard <= 0.2)
        return {rounded_to_float, guard, {}};
    if (storage == Storage::Float)
        throw Error("The mesh lies so far from the origin, or has so little range, that float coordinates are coarser "
                    "than its carriers. Move it to the origin, or use another method.");
    return {[](const Points& placed) { return placed; }, 0,
            "The mark is finer than float coordinates: save to a file format that holds doubles, or move the mesh to "
            "the origin first."};
}

} // namespace vcg_ext
