#include "geodesic.h"

#include "../placement/front.h"

#include <cmath>
#include <limits>
#include <memory>

namespace vcg_ext {

namespace {

/// What a vertex aims at: what it was told to, or its old distance, since a front that is moved before it would take it
/// along. Vertices before the first strip stay, as the front comes to them unchanged; so does the source's own face.
std::vector<double> front_targets(const Strips& strips, const Triangle& source_face, const std::vector<double>& told)
{
    std::vector<double> targets(told.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t v = 0; v < told.size(); ++v) {
        const double old = strips.arrivals[v].distance;
        if (old >= strips.carriers.low && std::isfinite(old))
            targets[v] = std::isnan(told[v]) ? old : told[v];
    }
    for (const int v : source_face)
        targets[v] = std::numeric_limits<double>::quiet_NaN();
    return targets;
}

} // namespace

std::vector<std::string> strip_warnings(const Strips& strips)
{
    std::vector<std::string> warnings;
    if (!strips.from_volume)
        warnings.emplace_back(
            "The mesh is not closed or not consistently oriented, so it is aligned by the moments of its "
            "surface. Cutting it or filling its holes afterwards loses the mark.");
    if (strips.unreached > 0)
        warnings.push_back(
            std::to_string(strips.unreached) +
            " vertices belong to parts of the mesh that are not connected with the part that carries the "
            "mark; they stay as they are.");
    return warnings;
}

ScalarMethod geodesic_method(const Cover& cover, const Key& key, const EmbedOptions& options, double trim,
                             EmbedReport& report)
{
    const Surface& surface = cover.surface;
    bool from_volume = false;
    const SurfacePoint source = keyed_source(surface, key, &from_volume);
    const auto strips = std::make_shared<Strips>(strips_from(source, surface, cover.around, trim, options.bits));
    strips->from_volume = from_volume;
    report.warnings = strip_warnings(*strips);
    ScalarMethod method;
    method.guard = 0.02; // the source moves along with the mark, and the strips with it
    method.cover = strips->carriers;
    method.cut = [strips, trim](int count) { return cut_range(strips->distances, 0, strips->farthest, trim, count); };
    // The least sum of squared distances from the surface: ask of each vertex in proportion to what it can do for free.
    // On fandisk the mark distorts a fifth of what it does with equal shares. The thesis' scheme has equal shares.
    method.mobility = options.front_scheme == FrontScheme::PredictCorrect
                          ? front_mobility(cover, strips->arrivals)
                          : std::vector<double>(surface.points.size(), 1);
    method.place = [&cover, strips, &report, scheme = options.front_scheme](const std::vector<double>& told) {
        FrontOptions front;
        front.scheme = scheme;
        const FrontPlacement placement =
            place_front(cover, strips->arrivals, front_targets(*strips, cover.triangles[strips->source.face], told),
                        1e-4 * strips->carriers.width, front);
        report.moves = placement.counts;
        report.guarded_vertices = placement.counts.unconverged;
        return placement.points;
    };
    method.read = [&cover, &surface, &key, trim, options](const Points& stored) {
        return read_strips({stored, surface.triangles}, cover.around, key, trim, options.bits, options.statistic)
            .carriers;
    };
    method.reframe = [&cover, strips, &surface, &key, trim, bits = options.bits](const Points& stored) {
        const Surface marked{stored, surface.triangles};
        const SurfacePoint source = keyed_source(marked, key);
        const double farthest = strips_from(source, marked, cover.around, trim, bits).farthest;
        *strips = strips_from(carried_along(source, marked, surface.points), surface, cover.around, trim, bits);
        strips->carriers = cut_range(strips->distances, 0, farthest, trim, bits);
        return strips->carriers;
    };
    return method;
}

} // namespace vcg_ext
