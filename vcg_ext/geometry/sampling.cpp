// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling.h"

#include "../key/random.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vcg_ext {

Sampling::Sampling(const Surface& surface, int count) : surface_(surface), count_(count)
{
    cumulative_.reserve(surface.triangles.size());
    for (const Triangle& t : surface.triangles)
        cumulative_.push_back(area_ += scaled_normal(surface.points, t).norm());
}

Sampling::Place Sampling::place(int number, Stream& draws) const
{
    const double at = (number + uniform(draws)) / count_ * area_;
    const auto found = std::lower_bound(cumulative_.begin(), cumulative_.end(), at);
    const auto face =
        std::min<std::ptrdiff_t>(found - cumulative_.begin(), static_cast<std::ptrdiff_t>(cumulative_.size()) - 1);
    const double r = std::sqrt(uniform(draws));
    const double s = uniform(draws);
    return {static_cast<int>(face), Point(1 - r, r * (1 - s), r * s)};
}

Point Sampling::point(const Place& place) const
{
    return weighted_point(surface_, place.face, place.weights);
}

SurfaceSamples sample_surface(const Surface& surface, int count, std::string_view purpose)
{
    const Sampling sampling(surface, count);
    Stream draws = seeded_stream(0, purpose);
    SurfaceSamples samples;
    for (const int share : draws.permutation(count)) {
        const Sampling::Place place = sampling.place(share, draws);
        samples.faces.push_back(place.face);
        samples.points.push_back(sampling.point(place));
        samples.normals.push_back(scaled_normal(surface.points, surface.triangles[place.face]).normalized());
    }
    return samples;
}

Spread farthest_points(const Points& points, int count)
{
    Spread spread;
    spread.nearest.assign(points.size(), 0);
    std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
    int next = 0;
    for (int chosen = 0; chosen < std::min(count, static_cast<int>(points.size())); ++chosen) {
        spread.chosen.push_back(next);
        const Point& last = points[next];
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (const double d = (points[i] - last).squaredNorm(); d < distance[i]) {
                distance[i] = d;
                spread.nearest[i] = chosen;
            }
            if (distance[i] > distance[next])
                next = static_cast<int>(i);
        }
    }
    return spread;
}

} // namespace vcg_ext
