// SPDX-License-Identifier: GPL-3.0-or-later
#include "spectral.h"

#include "patch_reading.h"

#include <limits>
#include <utility>

namespace vcg_ext {

namespace {

/// As printed, the grid ends in leftovers and has no flipped twin.
std::vector<AxisFlips> orientations(const Plan& plan)
{
    if (plan.options.as_printed)
        return {axis_flips.front()};
    return {axis_flips.begin(), axis_flips.end()};
}

int blind_orientation(const PatchReading& reading, const Plan& plan)
{
    const std::vector<AxisFlips> all = orientations(plan);
    int best = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t way = 0; way < all.size(); ++way) {
        const AxisFlips flips = all[way];
        if (!may_be_flipped(reading.frame, flips))
            continue;
        const std::vector<int> patches = carrying_patches(reading, plan, flips);
        double agreement = 0;
        for (int i = plan.options.bits; i < static_cast<int>(patches.size()); ++i)
            if (patches[i] >= 0)
                agreement += spare_bit(i - plan.options.bits) ? reading.soft(patches[i]) : -reading.soft(patches[i]);
        if (agreement > most) {
            most = agreement;
            best = static_cast<int>(way);
        }
    }
    return best;
}

} // namespace

Plan plan_spectral(const Key& key, const CarrierOptions& options)
{
    Plan plan;
    plan.options = options;
    plan.order = key.stream("patch-order").permutation(patch_count(options.bits, patch_layers));
    plan.trim = options.trim >= 0 ? options.trim : static_cast<double>(key.stream("trim").below(15001)) / 1e5;
    return plan;
}

MarkFrame find_spectral(const Surface& surface, const Plan& /*plan*/)
{
    return patch_frame(surface.points, solid_topology(surface));
}

Readings read_spectral(const Surface& surface, const Plan& plan, const MarkFrame& frame)
{
    PatchReading patches = read_patches(surface, plan, std::get<Frame>(frame));
    const std::vector<AxisFlips> all = orientations(plan);
    Readings readings;
    readings.blind = blind_orientation(patches, plan);
    for (const AxisFlips flips : all) {
        Reading reading;
        reading.weight = 1.0 / static_cast<double>(all.size());
        reading.orientation = name(flips);
        reading.label = carrying_patches(patches, plan, flips);
        reading.label.resize(plan.options.bits);
        for (const int patch : reading.label) {
            reading.soft.push_back(patch >= 0 ? patches.soft(patch) : 0);
            reading.samples.push_back(patch >= 0 ? patches.shapes[patch].samples : 0);
        }
        readings.ways.push_back(std::move(reading));
    }
    readings.label_of_vertex = std::move(patches.patches.label);
    return readings;
}

MarkFrame find_spectral_copy(const Copy& copy, const Plan& /*plan*/)
{
    return patch_frame(copy.original.points, solid_topology(copy.original));
}

Readings read_spectral_copy(const Copy& copy, const Plan& plan, const MarkFrame& frame)
{
    const Frame& axes = std::get<Frame>(frame);
    const Surface& original = copy.original;
    const int count = static_cast<int>(plan.order.size());
    const Patches whole = equal_area_patches(original.points, solid_topology(original), edge_graph(original), axes,
                                             patch_layers, count / patch_layers, plan.trim);
    PatchReading reading;
    reading.frame = axes;
    reading.patches = {whole.layers, whole.columns, {}};
    for (const Foot& foot : copy.feet()) {
        int nearest = 0;
        foot.weights.maxCoeff(&nearest);
        const bool stands = foot.face >= 0 && !foot.on_rim;
        reading.patches.label.push_back(stands ? whole.label[original.triangles[foot.face][nearest]] : -1);
    }
    read_given(copy.laid().points, edge_graph(copy.laid()), reading);

    Reading way;
    way.label = carrying_patches(reading, plan, {false, false});
    way.label.resize(plan.options.bits);
    for (int& patch : way.label) {
        way.samples.push_back(patch >= 0 ? reading.shapes[patch].samples : 0);
        const bool held = way.samples.back() >= vertices_of_a_shape;
        way.soft.push_back(held ? reading.soft(patch) : 0);
    }
    Readings readings;
    readings.ways.push_back(std::move(way));
    readings.label_of_vertex = std::move(reading.patches.label);
    return readings;
}

} // namespace vcg_ext
