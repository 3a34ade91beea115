// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesic.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace vcg_ext {

namespace {

/// What a vertex aims at: what it was told to, or its old distance, since a front that is moved before it would take it
/// along. Vertices before the first strip stay, as the front comes to them unchanged; so do the source's own face and
/// those that are held.
std::vector<double> front_targets(const Cover& cover, const Strips& strips, const Triangle& source_face,
                                  const std::vector<double>& told)
{
    std::vector<double> targets(cover.points.size(), std::numeric_limits<double>::quiet_NaN());
    for (int v = 0; v < static_cast<int>(strips.distances.size()); ++v) {
        const double old = strips.distances[v];
        if (old >= strips.carriers.low && std::isfinite(old) && !cover.holds(v))
            targets[v] = std::isnan(told[v]) ? old : told[v];
    }
    for (const int v : source_face)
        targets[v] = std::numeric_limits<double>::quiet_NaN();
    return targets;
}

/// What a user should know about the strips that were found.
std::vector<std::string> warnings_of(const StripFrame& frame, const Strips& strips)
{
    std::vector<std::string> warnings;
    if (frame.round)
        warnings.emplace_back(
            "The body is round about an axis, so its own axes are not sure, and Geodesic finds its source by them: the "
            "least change of the shape may lose the mark. Choose Layered, Waves or a method of vertex norms.");
    if (strips.unreached > 0)
        warnings.push_back(std::to_string(strips.unreached) +
                           " vertices belong to parts of the mesh that are not connected with the part that carries "
                           "the mark; they stay as they are.");
    return warnings;
}

/// What the carriers say in all, for either bit.
double evidence(const Reading& way)
{
    return std::inner_product(way.soft.begin(), way.soft.end(), way.soft.begin(), 0.0);
}

Surface closed(const SolidTopology& topology, const Points& vertices)
{
    return {solid_points(topology, vertices), topology.triangles};
}

/// A cover with its holes filled: itself where it has none.
class Filled {
public:
    Filled(const Cover& cover, const SolidTopology& topology) : cover_(cover)
    {
        if (topology.triangles.size() == cover.triangles.size())
            return;
        surface_ = closed(topology, cover.points);
        own_.emplace(surface_, cover.held);
    }

    Filled(const Filled&) = delete;
    Filled& operator=(const Filled&) = delete;

    [[nodiscard]] const Cover& cover() const { return own_ ? *own_ : cover_; }

private:
    const Cover& cover_;
    Surface surface_;
    std::optional<Cover> own_;
};

/// The distance from the source as embed_scalar() wants it.
class Distance {
public:
    Distance(const Cover& cover, const Plan& plan, FrontScheme scheme)
        : topology_(solid_topology(cover.surface)), filled_(cover, topology_), cover_(filled_.cover()),
          axes_(principal_frame(cover_.points, topology_)), fans_(fans_of(cover_.around, cover_.triangles)),
          plan_(plan), scheme_(scheme)
    {
    }

    static constexpr double guard = 0.02; // the source moves along with the mark, and the strips with it

    /// In the orientation of the cover: of an even body, the mark itself may flip the axes.
    [[nodiscard]] StripFrame find(const Points& points) const
    {
        const Surface body = closed(topology_, points);
        return strip_frame(body, turned_like(principal_frame(body.points, topology_), axes_), plan_.directions);
    }

    [[nodiscard]] Carriers read(const Points& points, const StripFrame& frame) const
    {
        return read_strips(closed(topology_, points), fans_, topology_.sites, frame, plan_.trim, plan_.options.bits,
                           plan_.options.statistic)
            .carriers;
    }

    [[nodiscard]] StripFrame on_cover(const Points& points, StripFrame frame) const
    {
        const Surface marked = closed(topology_, points);
        frame.farthest =
            strips_in(frame, distances_from(frame.source, marked.points, marked.triangles, fans_)).farthest;
        frame.source = carried_along(frame.source, marked, cover_.points);
        return frame;
    }

    void aim(const StripFrame& frame)
    {
        frame_ = frame;
        std::vector<double> distances = distances_from(frame.source, cover_.points, cover_.triangles, fans_);
        arrivals_ = arrivals_of(distances, frame.source, cover_.surface, cover_.around);
        strips_ = strips_in(frame, std::move(distances));
    }

    [[nodiscard]] Carriers cut(int count) const { return recut(strips_, plan_.trim, count); }

    /// The least sum of squared distances from the surface: ask of each vertex in proportion to what it can do for
    /// free. On fandisk the mark distorts a fifth of what it does with equal shares. The thesis' scheme has equal
    /// shares.
    [[nodiscard]] std::vector<double> mobility() const
    {
        std::vector<double> result = scheme_ == FrontScheme::PredictCorrect
                                         ? front_mobility(cover_, arrivals_)
                                         : std::vector<double>(cover_.points.size(), 1);
        for (std::size_t v = 0; v < cover_.held.size(); ++v)
            if (cover_.held[v])
                result[v] = 0;
        return result;
    }

    [[nodiscard]] Proposal place(const std::vector<double>& told) const
    {
        FrontOptions front;
        front.scheme = scheme_;
        FrontPlacement placed =
            place_front(cover_, arrivals_, front_targets(cover_, strips_, cover_.triangles[frame_.source.face], told),
                        1e-4 * strips_.carriers.width, front);
        Proposal proposal;
        proposal.points = std::move(placed.points);
        proposal.points.resize(topology_.sites);
        proposal.guarded_vertices = placed.counts.unconverged;
        proposal.moves = placed.counts;
        return proposal;
    }

    [[nodiscard]] std::vector<std::string> warnings() const { return warnings_of(frame_, strips_); }

private:
    [[nodiscard]] Strips strips_in(const StripFrame& frame, std::vector<double> distances) const
    {
        return strips_from(frame, std::move(distances), topology_.sites, plan_.trim, plan_.options.bits);
    }

    SolidTopology topology_;
    Filled filled_;
    const Cover& cover_; ///< the closed surface
    Frame axes_;         ///< of the cover
    Fans fans_;
    const Plan& plan_;
    FrontScheme scheme_;
    StripFrame frame_;
    std::vector<Arrival> arrivals_; ///< on the cover, in that frame
    Strips strips_;
};

} // namespace

Plan plan_geodesic(const Key& key, const CarrierOptions& options)
{
    Plan plan;
    plan.options = options;
    // The thesis draws from (0, 0.2), but where nearly nothing is cut off, the first and the last strip are too small to
    // hold a vertex; so in [0.05, 0.2].
    plan.trim = options.trim >= 0 ? options.trim : 0.05 + static_cast<double>(key.stream("epsilon").below(15001)) / 1e5;
    plan.order = key.stream("carrier-order").permutation(options.bits);
    plan.directions = source_directions(key.stream("direction"));
    return plan;
}

MarkFrame find_geodesic(const Surface& surface, const Plan& plan)
{
    const SolidTopology topology = solid_topology(surface);
    const Surface body = closed(topology, surface.points);
    return strip_frames(body, principal_frame(body.points, topology), plan.directions);
}

Readings read_geodesic(const Surface& surface, const Plan& plan, const MarkFrame& frame)
{
    const SolidTopology topology = solid_topology(surface);
    const Surface body = closed(topology, surface.points);
    const Fans fans = fans_of(vertex_faces(topology.points(), topology.triangles), topology.triangles);
    const auto& frames = std::get<StripFrames>(frame);
    Readings readings;
    std::vector<Reading> ways;
    double most = -1;
    for (const StripFrame& held : frames) {
        Strips strips =
            read_strips(body, fans, topology.sites, held, plan.trim, plan.options.bits, plan.options.statistic);
        Readings here = read_carriers(std::move(strips.carriers), plan);
        ways.push_back(std::move(here.ways.front()));
        ways.back().weight = 1.0 / static_cast<double>(frames.size());
        ways.back().orientation = held.orientation;
        const double found = evidence(ways.back());
        if (found <= most)
            continue;
        most = found;
        readings = std::move(here);
        readings.blind = static_cast<int>(ways.size()) - 1;
        readings.smoothing_rounds = strips.smoothing_rounds;
        readings.warnings = warnings_of(held, strips);
    }
    readings.ways = std::move(ways);
    return readings;
}

MarkFrame find_geodesic_copy(const Copy& copy, const Plan& plan)
{
    return find_geodesic(copy.original, plan);
}

Readings read_geodesic_copy(const Copy& copy, const Plan& plan, const MarkFrame& frame)
{
    const SolidTopology topology = solid_topology(copy.original);
    const Surface original = closed(topology, copy.original.points);
    const Fans fans = fans_of(vertex_faces(topology.points(), topology.triangles), topology.triangles);
    const StripFrame& first = std::get<StripFrames>(frame).front();
    const Strips strips = strips_from(first, distances_from(first.source, original.points, original.triangles, fans),
                                      topology.sites, plan.trim, plan.options.bits);
    std::vector<double> distances;
    for (const Foot& foot : copy.feet()) {
        double distance = -1;
        if (foot.face >= 0 && !foot.on_rim) {
            distance = 0;
            for (int k = 0; k < 3; ++k)
                distance += foot.weights[k] * strips.distances[original.triangles[foot.face][k]];
        }
        distances.push_back(distance);
    }
    return read_part(cut_range(distances, 0, strips.farthest, plan.trim, plan.options.bits), strips.carriers,
                     copy.left(), plan);
}

Marking embed_geodesic(const Cover& cover, const Plan& plan, const Bits& coded, const PlacementOptions& options,
                       const Progress& progress)
{
    Distance distance(cover, plan, options.front_scheme);
    Marking marking = embed_scalar(distance, cover, plan, coded, options, progress);
    const std::vector<std::string> warnings = distance.warnings();
    marking.warnings.insert(marking.warnings.end(), warnings.begin(), warnings.end());
    return marking;
}

} // namespace vcg_ext
