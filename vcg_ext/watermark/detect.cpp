// SPDX-License-Identifier: GPL-3.0-or-later
#include "detect.h"

#include "../base/stopwatch.h"
#include "../geometry/body.h"
#include "conclusion.h"
#include "pieces.h"

#include <map>
#include <utility>

namespace vcg_ext {

DetectReport detect_by(const LayerReader& read, const std::vector<int>& site_of_vertex, double share, const Key& key,
                       const DetectOptions& options, const Progress& progress)
{
    options.carriers.check();
    Stopwatch watch;
    DetectReport result = conclude(options, try_counts(read, key, options, share, progress), site_of_vertex);
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
