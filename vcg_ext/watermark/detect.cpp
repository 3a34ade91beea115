// SPDX-License-Identifier: GPL-3.0-or-later
#include "detect.h"

#include "../base/check.h"
#include "../base/stopwatch.h"
#include "../method/methods.h"
#include "judge.h"
#include "secrets.h"

namespace vcg_ext {

namespace {

/// Per vertex of the unwelded surface the number of the bit that it carries, or -1.
std::vector<int> carrier_of_vertex(const Readings& readings, const Reading& way, const std::vector<int>& site_of_vertex)
{
    std::vector<int> carrier_of_label;
    for (std::size_t i = 0; i < way.label.size(); ++i)
        if (way.label[i] >= 0) {
            if (way.label[i] >= static_cast<int>(carrier_of_label.size()))
                carrier_of_label.resize(way.label[i] + 1, -1);
            carrier_of_label[way.label[i]] = static_cast<int>(i);
        }
    std::vector<int> result(site_of_vertex.size(), -1);
    if (readings.label_of_vertex.empty())
        return result;
    for (std::size_t v = 0; v < result.size(); ++v) {
        const int label = site_of_vertex[v] >= 0 ? readings.label_of_vertex[site_of_vertex[v]] : -1;
        if (label >= 0 && label < static_cast<int>(carrier_of_label.size()))
            result[v] = carrier_of_label[label];
    }
    return result;
}

} // namespace

DetectReport detect(const Surface& surface, const Key& key, const DetectOptions& options, const Progress& progress)
{
    options.carriers.check();
    Stopwatch watch;
    report(progress, 0, "Finding carriers");
    const Welded welded = checked_weld(surface);
    const MethodRow& method = row_of(options.carriers.method);
    const Plan plan = method.plan(key, options.carriers);
    const MarkFrame frame = method.find_frame(welded.surface, plan);
    report(progress, 30, "Reading");
    Readings readings = method.read(welded.surface, plan, frame);

    const int count = options.carriers.bits;
    const Bits mask = bit_mask(key, count);
    std::optional<Bits> expected = options.expected;
    if (expected)
        expected = pad_message(*expected, count);
    Judgement judgement = judge(readings, mask, expected);
    const Reading& way = readings.ways[judgement.way];

    DetectReport result;
    result.method = options.carriers.method;
    result.statistic = options.carriers.statistic;
    result.trim = plan.trim;
    result.bits = std::move(judgement.bits);
    result.soft = unmasked(way, mask);
    result.samples = way.samples;
    result.detection_ratio = judgement.detection_ratio;
    result.p_value = judgement.p_value;
    result.present = judgement.present;
    result.smoothing_rounds = readings.smoothing_rounds;
    result.orientation = way.orientation;
    result.carrier_of_vertex = carrier_of_vertex(readings, way, welded.site_of_vertex);
    result.warnings = std::move(readings.warnings);
    result.seconds["detection"] = watch.lap();
    report(progress, 100, "Done");
    return result;
}

} // namespace vcg_ext
