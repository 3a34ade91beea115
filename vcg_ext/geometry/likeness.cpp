// SPDX-License-Identifier: GPL-3.0-or-later
#include "likeness.h"

#include "../base/pi.h"
#include "moments.h"
#include "size.h"
#include "solid.h"

#include <cmath>

namespace vcg_ext {

namespace {

SurfaceSamples samples_for_features(const Surface& surface)
{
    constexpr int count = 12000;
    return sample_surface(surface, count, "features");
}

/// -1 where the faces look in.
double side_of(const Surface& surface)
{
    return signed_volume(surface, surface_stand(surface).centre) < 0 ? -1 : 1;
}

} // namespace

Stand surface_stand(const Surface& surface)
{
    const Frame frame = area_frame(surface.points, surface.triangles);
    return {frame.centre, frame.axes, std::sqrt(frame.measure)};
}

Stand solid_stand(const Surface& surface)
{
    const SolidTopology topology = solid_topology(surface);
    const Frame frame = solid_frame(solid_points(topology, surface.points), topology.triangles);
    return {frame.centre, frame.axes, frame.measure == 0 ? 0 : ball_radius(frame)};
}

double Likeness::size() const
{
    return solid.length > 0 ? solid.length : surface.length / std::sqrt(4 * pi);
}

Likeness likeness_of(const Surface& original)
{
    return {
        solid_stand(original), surface_stand(original), bounding_diagonal(original), mean_edge_length(original), {}};
}

Features own_features(const Surface& original, int count)
{
    const SurfaceSamples samples = samples_for_features(original);
    return features_of(samples, surface_area(original), spread_points(samples, count), {bounding_diagonal(original)},
                       side_of(original));
}

Features own_features(const Surface& original, const Points& points)
{
    return features_of(samples_for_features(original), surface_area(original), points, {bounding_diagonal(original)},
                       side_of(original));
}

Features features_to_match(const Surface& surface, const std::vector<double>& sizes)
{
    constexpr int count = 800;
    const SurfaceSamples samples = samples_for_features(surface);
    return features_of(samples, surface_area(surface), spread_points(samples, count), sizes, side_of(surface));
}

} // namespace vcg_ext
