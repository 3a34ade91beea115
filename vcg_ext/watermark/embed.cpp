// SPDX-License-Identifier: GPL-3.0-or-later
#include "embed.h"

#include "../base/check.h"
#include "../base/stopwatch.h"
#include "../method/methods.h"
#include "../metric/displacement.h"
#include "detect.h"
#include "secrets.h"

#include <algorithm>

namespace vcg_ext {

namespace {

EmbedOptions completed(EmbedOptions options)
{
    if (options.carriers.bits == 0)
        options.carriers.bits = static_cast<int>(options.message.size());
    options.carriers.check();
    options.placement.check();
    options.placement.strength = checked_strength(options.carriers, options.placement.strength);
    options.message = pad_message(options.message, options.carriers.bits);
    return options;
}

/// Reads blind what was embedded: without the message, unless the body's ends can only be told apart by it.
double self_check(const Surface& marked, const Key& key, const EmbedOptions& options, EmbedReport& result,
                  const Progress& progress)
{
    const auto quietly = [&progress](int, const char*) { return !progress || progress(85, "Checking blind"); };
    if (detect(marked, key, {options.carriers, {}}, quietly).bits == result.bits)
        return 1;
    const DetectReport found = detect(marked, key, {options.carriers, result.bits}, quietly);
    if (*found.detection_ratio == 1)
        result.warnings.emplace_back("The body is so symmetric that with this key the message can only be read by who "
                                     "knows what to expect. Set it for detection too, or take another key.");
    return *found.detection_ratio;
}

} // namespace

EmbedReport embed(Surface& surface, const Key& key, const EmbedOptions& wanted, const Progress& progress)
{
    const EmbedOptions options = completed(wanted);
    report(progress, 0, "Finding carriers");
    Stopwatch watch;
    const Welded welded = checked_weld(surface);
    const Cover cover(welded.surface);
    const MethodRow& method = row_of(options.carriers.method);
    const Plan plan = method.plan(key, options.carriers);
    const Bits mask = bit_mask(key, options.carriers.bits);
    Marking marking = method.embed(cover, plan, masked(options.message, mask), options.placement, progress);

    EmbedReport result;
    result.method = options.carriers.method;
    result.statistic = options.carriers.statistic;
    result.bits = options.message;
    result.strength = options.placement.strength;
    result.trim = plan.trim;
    result.carriers = options.carriers.bits;
    result.samples_min = marking.samples_min;
    result.capacity = marking.capacity;
    result.rounds = marking.rounds;
    result.guarded_vertices = marking.kept.guarded_vertices;
    result.solver = marking.kept.solver;
    result.moves = marking.kept.moves;
    result.warnings = std::move(marking.warnings);
    result.seconds["placement"] = watch.lap();

    report(progress, 85, "Checking blind");
    const Points stored = options.placement.storage == Storage::Float ? rounded_to_float(marking.kept.points)
                                                                      : std::move(marking.kept.points);
    Surface marked{unweld(surface.points, welded.site_of_vertex, stored), surface.triangles};
    result.detection_ratio = self_check(marked, key, options, result, progress);
    if (result.detection_ratio < 1)
        throw DoesNotFit("The blind self-check did not read every bit back.", marking.capacity);
    result.seconds["check"] = watch.lap();

    report(progress, 95, "Measuring");
    result.moved_vertices = moved_count(surface.points, marked.points);
    result.max_displacement = max_displacement(surface.points, marked.points);
    result.mrms = local_mrms(cover.points, stored, cover.triangles, cover.around);
    result.mrms_relative = result.mrms / bounding_diagonal(welded.surface);
    result.seconds["measure"] = watch.lap();
    report(progress, 100, "Done");
    surface.points = std::move(marked.points);
    return result;
}

int carriers_that_fit(const Surface& surface, const Key& key, const EmbedOptions& wanted, const DoesNotFit& cause,
                      const Progress& progress)
{
    EmbedOptions options = completed(wanted);
    const int most = 3 * options.carriers.bits / 4;
    int count = cause.roomy() > 0 ? std::min(most, 3 * cause.roomy() / 4) : most;
    for (int attempt = 0; attempt < 2 && count > 0; ++attempt, count /= 2) {
        options.carriers.bits = count;
        options.message.resize(count);
        Surface copy = surface;
        try {
            embed(copy, key, options,
                  [&progress](int, const char*) { return !progress || progress(50, "Finding how many bits fit"); });
            return count;
        } catch (const DoesNotFit&) { // the next is fewer
        }
    }
    return 0;
}

} // namespace vcg_ext
