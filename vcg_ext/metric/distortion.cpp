// SPDX-License-Identifier: GPL-3.0-or-later
#include "distortion.h"

#include "../base/check.h"
#include "../base/parallel.h"
#include "../base/weld.h"
#include "../geometry/boundary.h"
#include "../geometry/closest.h"
#include "../geometry/curve.h"
#include "../geometry/moments.h"
#include "../geometry/renumber.h"
#include "../geometry/sampling.h"
#include "../geometry/size.h"
#include "../key/random.h"
#include "../key/stream.h"
#include "perceptual.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vcg_ext {

namespace {

/// Two surfaces with every position once. Where both have the same faces, so have these, and vertices correspond.
struct Pair {
    Surface reference;
    Surface measured;
    std::vector<int> site_of_vertex; ///< per vertex of the measured mesh as it came
    bool same_faces = false;
};

/// The positions of `measured` for the sites of the reference; empty where vertices that share one there do not here.
Points corresponding_sites(const Surface& measured, const Welded& reference)
{
    Points sites(reference.surface.points.size());
    std::vector<char> known(sites.size(), 0);
    for (std::size_t v = 0; v < measured.points.size(); ++v) {
        const int site = reference.site_of_vertex[v];
        if (site < 0)
            continue;
        if (known[site] && sites[site] != measured.points[v])
            return {};
        sites[site] = measured.points[v];
        known[site] = 1;
    }
    return sites;
}

Pair pair_of(const Surface& reference, const Surface& measured)
{
    Welded first = weld(reference);
    if (reference.points.size() == measured.points.size() && reference.triangles == measured.triangles) {
        Points sites = corresponding_sites(measured, first);
        if (!sites.empty())
            return {first.surface, {std::move(sites), first.surface.triangles}, first.site_of_vertex, true};
    }
    Welded second = weld(measured);
    return {std::move(first.surface), std::move(second.surface), std::move(second.site_of_vertex), false};
}

/// What is looked for in turn is near each other then, and so is what the search walks through.
void number_by_curve(Pair& pair)
{
    const std::vector<int> order = curve_order(pair.reference.points);
    std::vector<int> vertices_of_reference;
    renumber(pair.reference, vertices_of_reference, order);
    renumber(pair.measured, pair.site_of_vertex, pair.same_faces ? order : curve_order(pair.measured.points));
}

struct OneWay {
    double squares = 0;
    double sum = 0;
    double most = 0;
};

/// Distances of samples of `from` to `to`. Where both have the same faces, a point is no further than its counterpart.
OneWay sampled(const Surface& from, const Surface& to, const ClosestSearch& nearest, bool same_faces, int samples,
               std::uint64_t seed, const char* purpose, const Progress& progress, const char* phase)
{
    constexpr int chunk = 4096;
    const Sampling sampling(from, samples);
    std::vector<OneWay> partial(chunk_count(samples, chunk));
    for_chunks(samples, chunk, progress, phase, [&](int begin, int end) {
        Stream draws = seeded_stream(seed, purpose, begin / chunk);
        OneWay& part = partial[begin / chunk];
        for (int i = begin; i < end; ++i) {
            const Sampling::Place place = sampling.place(i, draws);
            const Point p = sampling.point(place);
            double distance = nearest(p).distance;
            if (same_faces)
                distance = std::min(distance, (weighted_point(to, place.face, place.weights) - p).norm());
            part.squares += distance * distance;
            part.sum += distance;
            part.most = std::max(part.most, distance);
        }
    });
    OneWay total;
    for (const OneWay& part : partial) {
        total.squares += part.squares;
        total.sum += part.sum;
        total.most = std::max(total.most, part.most);
    }
    return total;
}

std::vector<ClosestPoint> from_vertices(const Points& points, const ClosestSearch& nearest, const Progress& progress)
{
    constexpr int chunk = 4096;
    std::vector<ClosestPoint> result(points.size());
    for_chunks(static_cast<int>(points.size()), chunk, progress, "Vertices", [&](int begin, int end) {
        for (int v = begin; v < end; ++v)
            result[v] = nearest(points[v]);
    });
    return result;
}

double most(const std::vector<ClosestPoint>& found)
{
    double result = 0;
    for (const ClosestPoint& point : found)
        result = std::max(result, point.distance);
    return result;
}

std::optional<double> signal_to_noise(const Pair& pair, const std::vector<ClosestPoint>& nearest)
{
    const Points& original = pair.reference.points;
    Point mean = Point::Zero();
    for (const Point& p : original)
        mean += p / static_cast<double>(original.size());
    double signal = 0;
    double noise = 0;
    for (std::size_t v = 0; v < pair.measured.points.size(); ++v) {
        const Point& counterpart = pair.same_faces ? original[v] : nearest[v].point;
        signal += (counterpart - mean).squaredNorm();
        noise += (pair.measured.points[v] - counterpart).squaredNorm();
    }
    if (!(noise > 0 && signal > 0))
        return std::nullopt;
    return 10 * std::log10(signal / noise);
}

void compare_sizes(const Pair& pair, DistortionReport& result)
{
    const double before = surface_area(pair.reference);
    result.area_change = (surface_area(pair.measured) - before) / before;
    if (!is_closed_and_oriented(pair.reference) || !is_closed_and_oriented(pair.measured)) {
        result.warnings.emplace_back("Volume not compared: a mesh is open, or its faces are not oriented alike.");
        return;
    }
    const Point centre = pair.reference.points[0];
    const double volume = signed_volume(pair.reference, centre);
    if (std::abs(volume) > 1e-12 * before * bounding_diagonal(pair.reference))
        result.volume_change = (signed_volume(pair.measured, centre) - volume) / volume;
    else
        result.warnings.emplace_back("Volume not compared: the reference mesh encloses none.");
}

} // namespace

DistortionReport measure(const Surface& reference, const Surface& measured, const DistortionOptions& options,
                         const Progress& progress)
{
    if (options.samples < 0)
        throw Error("Samples is " + std::to_string(options.samples) +
                    ", but must be 1 or more, or 0 for ten per vertex of the larger mesh.");
    check_surface(reference, "reference mesh");
    check_surface(measured, "measured mesh");
    report(progress, 0, "Search trees");
    Pair pair = pair_of(reference, measured);
    number_by_curve(pair);
    std::optional<ClosestSearch> trees[2];
    side_by_side([&] { trees[0].emplace(pair.reference); }, [&] { trees[1].emplace(pair.measured); });
    const ClosestSearch& to_reference = *trees[0];
    const ClosestSearch& to_measured = *trees[1];
    report(progress, 3, "Search trees");

    DistortionReport result;
    const std::size_t larger = std::max(pair.reference.points.size(), pair.measured.points.size());
    result.samples = options.samples > 0
                         ? options.samples
                         : static_cast<int>(std::min<std::size_t>(10 * larger, std::numeric_limits<int>::max()));
    const OneWay forward = sampled(pair.reference, pair.measured, to_measured, pair.same_faces, result.samples,
                                   options.seed, "forward", within(progress, 5, 35), "Reference to measured");
    const OneWay backward = sampled(pair.measured, pair.reference, to_reference, pair.same_faces, result.samples,
                                    options.seed, "backward", within(progress, 35, 65), "Measured to reference");
    const std::vector<ClosestPoint> of_measured =
        from_vertices(pair.measured.points, to_reference, within(progress, 65, 70));
    const std::vector<ClosestPoint> of_reference =
        from_vertices(pair.reference.points, to_measured, within(progress, 70, 75));

    result.mrms = std::sqrt(std::max(forward.squares, backward.squares) / result.samples);
    result.mean = std::max(forward.sum, backward.sum) / result.samples;
    result.hausdorff = std::max({forward.most, backward.most, most(of_measured), most(of_reference)});
    result.diagonal = bounding_diagonal(pair.reference);
    result.mrms_relative = result.mrms / result.diagonal;
    result.mean_relative = result.mean / result.diagonal;
    result.hausdorff_relative = result.hausdorff / result.diagonal;
    result.snr_db = signal_to_noise(pair, of_measured);
    compare_sizes(pair, result);

    result.msdm = msdm(pair.reference, pair.measured, pair.same_faces, within(progress, 75, 100));
    if (!pair.same_faces)
        result.warnings.emplace_back(
            "The meshes differ in their faces: SNR and MSDM compare vertices with the nearest points instead.");

    result.distance.assign(measured.points.size(), 0);
    for (std::size_t v = 0; v < measured.points.size(); ++v)
        if (const int site = pair.site_of_vertex[v]; site >= 0)
            result.distance[v] = of_measured[site].distance;
    report(progress, 100, "Structural distance");
    return result;
}

} // namespace vcg_ext
