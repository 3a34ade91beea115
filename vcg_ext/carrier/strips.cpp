// SPDX-License-Identifier: GPL-3.0-or-later
#include "strips.h"

#include "../base/error.h"
#include "../base/parallel.h"
#include "../geometry/normal_smoothing.h"
#include "../key/random.h"
#include "../key/stream.h"
#include "statistic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace vcg_ext {

namespace {

/// How far the statistics lie from the threshold, in all: sum of n s^2.
double evidence(const Carriers& carriers, Statistic statistic)
{
    const std::vector<int> count = samples(carriers);
    const std::vector<double> read = statistics(carriers, statistic);
    double sum = 0;
    for (int k = 0; k < carriers.count; ++k)
        sum += count[k] * (read[k] - threshold(statistic)) * (read[k] - threshold(statistic));
    return sum;
}

} // namespace

Points source_directions(Stream draws)
{
    constexpr int tries = 1000;
    Points directions;
    for (int i = 0; i < tries; ++i)
        directions.push_back(integer_direction(draws));
    return directions;
}

StripFrame strip_frame(const Surface& closed, const Frame& frame, const Points& directions)
{
    if (frame.measure == 0)
        throw Error("No face of the mesh has an area. Check its coordinates, or reconstruct the surface.");
    for (const Point& direction : directions)
        if (const auto hit = farthest_hit(closed, frame.centre, frame.axes * direction))
            return {*hit, {}, is_round(frame), {}};
    throw Error("No ray from the mesh's centre meets its surface, so geodesic distances have no source. "
                "Use another method, or a more complete mesh.");
}

StripFrames strip_frames(const Surface& closed, const Frame& frame, const Points& directions)
{
    StripFrames frames;
    for (const AxisFlips flips : axis_flips)
        if (may_be_flipped(frame, flips)) {
            frames.push_back(strip_frame(closed, flipped(frame, flips), directions));
            frames.back().orientation = name(flips);
        }
    if (frames.size() == 1)
        frames.front().orientation.clear();
    return frames;
}

Strips strips_from(const StripFrame& frame, std::vector<double> distances, int carrying, double trim, int count)
{
    Strips strips;
    strips.distances = std::move(distances);
    strips.distances.resize(carrying);
    for (const double distance : strips.distances) {
        if (std::isinf(distance))
            ++strips.unreached;
        else
            strips.farthest = std::max(strips.farthest, distance);
    }
    if (frame.farthest)
        strips.farthest = *frame.farthest;
    strips.carriers = recut(strips, trim, count);
    return strips;
}

Carriers recut(const Strips& strips, double trim, int count)
{
    return cut_range(strips.distances, 0, strips.farthest, trim, count);
}

SurfacePoint carried_along(const SurfacePoint& source, const Surface& surface, const Points& points)
{
    const auto& [a, b, c] = surface.triangles[source.face];
    const Point ab = surface.points[b] - surface.points[a];
    const Point ac = surface.points[c] - surface.points[a];
    const Point as = source.position - surface.points[a];
    const Point normal = ab.cross(ac);
    const double square = normal.squaredNorm();
    if (!(square > 0))
        return {source.face, points[a]};
    const double along_b = as.cross(ac).dot(normal) / square;
    const double along_c = ab.cross(as).dot(normal) / square;
    return {source.face, points[a] + along_b * (points[b] - points[a]) + along_c * (points[c] - points[a])};
}

Strips read_strips(const Surface& closed, const Fans& fans, int carrying, const StripFrame& frame, double trim,
                   int count, Statistic statistic)
{
    constexpr std::array<int, 3> rounds = {0, 1, 3};
    std::array<Points, rounds.size()> smooth = {closed.points};
    for (std::size_t i = 1; i < rounds.size(); ++i)
        smooth[i] = smoothed_along_normals(smooth[i - 1], fans, rounds[i] - rounds[i - 1], 0.5);
    std::array<Strips, rounds.size()> strips;
    std::array<double, rounds.size()> found{};
    for_chunks(static_cast<int>(rounds.size()), 1, [&](int i, int) { // a march goes on one core
        const SurfacePoint source = carried_along(frame.source, closed, smooth[i]);
        strips[i] =
            strips_from(frame, distances_from(source, smooth[i], closed.triangles, fans), carrying, trim, count);
        strips[i].smoothing_rounds = rounds[i];
        found[i] = evidence(strips[i].carriers, statistic);
    });
    return std::move(strips[std::max_element(found.begin(), found.end()) - found.begin()]);
}

} // namespace vcg_ext
