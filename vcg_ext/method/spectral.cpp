// SPDX-License-Identifier: GPL-3.0-or-later
#include "spectral.h"

#include "../base/error.h"
#include "../base/parallel.h"
#include "../carrier/two_means.h"
#include "../geometry/chebyshev.h"
#include "../geometry/eigenbasis.h"
#include "../geometry/size.h"
#include "../placement/fold_guard.h"
#include "closed_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vcg_ext {

namespace {

constexpr int layers = 2;          // the thesis' kappa
constexpr double cutoff = 2;       // the highest 90 % of a mesh's eigenvalues
constexpr double high_share = 0.7; // the same, as the thesis prints it
constexpr double printed_threshold = 2.25;
constexpr double few = 0.2; // of the vertices: where no more moved in a round, they move no cut to speak of

} // namespace

double PatchReading::soft(int patch) const
{
    const PatchShape& shape = shapes[patch];
    return (std::log(shape.ratio()) - threshold) * std::sqrt(shape.samples) / 2;
}

namespace {

Points about(const Point& centre, const Points& points)
{
    Points result(points.size());
    for_each_index(static_cast<int>(points.size()), [&](int v) { result[v] = points[v] - centre; });
    return result;
}

HighPass filter_of(const EdgeGraph& graph)
{
    const double bound = laplacian_bound(graph);
    return high_pass(cutoff, bound, high_pass_degree(bound));
}

Points filtered(const EdgeGraph& graph, const Points& points)
{
    return apply(filter_of(graph), graph, points);
}

Points exact_bands(const EdgeGraph& graph, const Points& points, const std::vector<std::vector<int>>& patches)
{
    Points band(points.size(), Point::Zero());
    for_chunks(static_cast<int>(patches.size()), 1, [&](int k, int) {
        const Points rows = exact_high_band(graph, points, patches[k], high_share);
        for (std::size_t i = 0; i < rows.size(); ++i)
            band[patches[k][i]] = rows[i];
    });
    return band;
}

constexpr int vertices_of_a_shape = 8; ///< at least

double best_threshold(const std::vector<PatchShape>& shapes, int least_samples = 0)
{
    std::vector<double> ratios;
    ratios.reserve(shapes.size());
    for (const PatchShape& shape : shapes)
        if (shape.samples >= least_samples)
            ratios.push_back(std::log(shape.ratio()));
    return two_means(std::move(ratios));
}

Frame checked_frame(const Points& vertices, const SolidTopology& topology)
{
    Frame frame = principal_frame(solid_points(topology, vertices), topology);
    if (frame.measure == 0)
        throw Error("No face of the mesh has an area. Check its coordinates, or reconstruct the surface.");
    return frame;
}

void measure_shapes(PatchReading& reading)
{
    reading.shapes.resize(reading.vertices.size());
    for_chunks(static_cast<int>(reading.vertices.size()), 1,
               [&](int k, int) { reading.shapes[k] = patch_shape(reading.band, reading.vertices[k]); });
}

PatchReading read_with(const Surface& surface, const SolidTopology& topology, const EdgeGraph& graph, const Plan& plan,
                       const Frame& frame)
{
    const int count = static_cast<int>(plan.order.size());
    const bool as_printed = plan.options.as_printed;
    PatchReading reading;
    reading.frame = frame;
    reading.patches =
        as_printed ? thesis_patches(surface, frame, layers, count, plan.trim)
                   : equal_area_patches(surface.points, topology, graph, frame, layers, count / layers, plan.trim);
    reading.vertices = patch_vertices(reading.patches);
    const Points local = about(frame.centre, surface.points);
    reading.band = as_printed ? exact_bands(graph, local, reading.vertices) : filtered(graph, local);
    measure_shapes(reading);
    reading.threshold = as_printed ? std::log(printed_threshold) : best_threshold(reading.shapes);
    return reading;
}

} // namespace

PatchReading read_patches(const Surface& surface, const Plan& plan, const Frame& frame)
{
    return read_with(surface, solid_topology(surface), edge_graph(surface), plan, frame);
}

std::vector<int> carrying_patches(const PatchReading& reading, const Plan& plan, AxisFlips flips)
{
    // As printed, the number of patches hangs on the mesh: those that it lacks are passed over.
    std::vector<int> patches;
    for (const int patch : plan.order)
        if (patch < reading.patches.count())
            patches.push_back(reading.patches.flipped(patch, flips));
    patches.resize(plan.order.size(), -1);
    return patches;
}

namespace {

/// As printed, the grid ends in leftovers and has no flipped twin.
std::vector<AxisFlips> orientations(const Plan& plan)
{
    if (plan.options.as_printed)
        return {axis_flips.front()};
    return {axis_flips.begin(), axis_flips.end()};
}

bool spare_bit(int number)
{
    return number % 2 == 1;
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

/// What a patch is to become, and when that is good enough.
struct Aim {
    double ratio;  ///< K of (3.20) for bit 1
    double round;  ///< for bit 0
    double energy; ///< least variance along axis 1 for bit 1; a quarter of it along each axis for bit 0

    /// Log ratio beyond what a later round would better; negative where it would.
    [[nodiscard]] double margin(bool bit, const PatchShape& shape) const
    {
        const double least = std::max(ratio / 1.3, std::pow(ratio, 0.75));
        const double most = std::min(1.3, std::pow(ratio, 0.25));
        return bit ? std::log(shape.ratio() / least) : std::log(most / shape.ratio());
    }
};

/// The energy above which noise and quantization of the usual strengths leave a ratio to be read: 1.6e-3 of the
/// diagonal squared, but never more than three tenths of an edge.
double least_energy(const Surface& surface)
{
    return std::pow(std::min(1.57e-3 * bounding_diagonal(surface), 0.285 * mean_edge_length(surface)), 2);
}

/// Takes moves back by halves where a face would fold; returns how many vertices that befell.
int guard(const Cover& cover, Points& points)
{
    constexpr int steps = 8;
    const Points wanted = points;
    const std::vector<int> step = guard_folds(cover, points, steps, [&](int v, int s) {
        return Point(cover.points[v] + (wanted[v] - cover.points[v]) * std::exp2(-s));
    });
    return static_cast<int>(std::count_if(step.begin(), step.end(), [](int s) { return s > 0; }));
}

/// Per patch the bit that it is to carry, or -1.
std::vector<int> bits_of_patches(const PatchReading& reading, const Plan& plan, const Bits& bits)
{
    std::vector<int> result(reading.patches.count(), -1);
    const std::vector<int> patches = carrying_patches(reading, plan, {});
    for (std::size_t i = 0; i < patches.size(); ++i)
        if (patches[i] >= 0 && i < bits.size())
            result[patches[i]] = bits[i];
        else if (patches[i] >= 0 && !plan.options.as_printed)
            result[patches[i]] = spare_bit(static_cast<int>(i - bits.size()));
    return result;
}

/// Unit normals of some vertices of the cover.
Points normals_of(const Cover& cover, const std::vector<int>& vertices)
{
    Points normals;
    normals.reserve(vertices.size());
    for (const int v : vertices) {
        Point sum = Point::Zero();
        std::for_each(cover.around.begin(v), cover.around.end(v),
                      [&](int f) { sum += cover.areas[f] * cover.normals[f]; });
        normals.push_back(sum.normalized());
    }
    return normals;
}

/// Moves the vertices of the patches that lack margin; all but those that fulfil their condition `at_first`.
void reshape(const PatchReading& reading, const Plan& plan, const std::vector<int>& wanted, const Aim& aim,
             const Cover& cover, bool at_first, Points& points)
{
    for_chunks(static_cast<int>(wanted.size()), 1, [&](int k, int) {
        const PatchShape& shape = reading.shapes[k];
        const std::vector<int>& vertices = reading.vertices[k];
        if (wanted[k] < 0 || (!at_first && aim.margin(wanted[k], shape) >= 0))
            return;
        const bool squash = wanted[k] == 1;
        const double ratio = squash ? aim.ratio : aim.round;
        const Points moves = plan.options.as_printed
                                 ? printed_change(shape, reading.band, vertices, ratio)
                                 : least_change(shape, reading.band, normals_of(cover, vertices), vertices, squash,
                                                ratio, squash ? aim.energy : aim.energy / 4);
        for (std::size_t i = 0; i < moves.size(); ++i)
            if (!cover.holds(vertices[i]))
                points[vertices[i]] += moves[i];
    });
}

/// Per patch that carries something, how far it is from wanting another round.
std::vector<double> margins_of(const PatchReading& reading, const std::vector<int>& wanted, const Aim& aim)
{
    std::vector<double> margins;
    for (std::size_t k = 0; k < wanted.size(); ++k)
        if (wanted[k] >= 0)
            margins.push_back(aim.margin(wanted[k], reading.shapes[k]));
    return margins;
}

int poorest(const PatchReading& reading, const std::vector<int>& wanted)
{
    int fewest = std::numeric_limits<int>::max();
    for (std::size_t k = 0; k < wanted.size(); ++k)
        if (wanted[k] >= 0)
            fewest = std::min(fewest, reading.shapes[k].samples);
    return fewest;
}

void check_patches(const PatchReading& reading, const std::vector<int>& bits, std::size_t wanted)
{
    if (bits.size() < wanted)
        throw DoesNotFit("The mesh has " + std::to_string(bits.size()) + " patches for " + std::to_string(wanted) +
                             " bits.",
                         static_cast<int>(bits.size()));
    for (std::size_t k = 0; k < bits.size(); ++k)
        if (bits[k] >= 0 && reading.shapes[k].samples < vertices_of_a_shape)
            throw DoesNotFit("A patch holds " + std::to_string(reading.shapes[k].samples) + " vertices, and " +
                             std::to_string(vertices_of_a_shape) + " are the fewest that have a shape.");
}

/// The vertices that are elsewhere.
std::vector<int> moved_vertices(const Points& before, const Points& now)
{
    std::vector<int> moved;
    for (std::size_t v = 0; v < now.size(); ++v)
        if (now[v] != before[v])
            moved.push_back(static_cast<int>(v));
    return moved;
}

/// Takes up what moves do to the bands; the cuts stay.
void read_moves(const HighPass& filter, const EdgeGraph& graph, const std::vector<int>& moved, const Points& before,
                const Points& now, PatchReading& reading)
{
    Points moves;
    for (const int v : moved)
        moves.emplace_back(now[v] - before[v]);
    add_band_of_moves(filter, graph, moved, moves, reading.band);
    measure_shapes(reading);
}

} // namespace

Plan plan_spectral(const Key& key, const CarrierOptions& options)
{
    Plan plan;
    plan.options = options;
    plan.order = key.stream("patch-order").permutation(patch_count(options.bits, layers));
    plan.trim = options.trim >= 0 ? options.trim : static_cast<double>(key.stream("trim").below(15001)) / 1e5;
    return plan;
}

MarkFrame find_spectral(const Surface& surface, const Plan& /*plan*/)
{
    return checked_frame(surface.points, solid_topology(surface));
}

Marking embed_spectral(const Cover& cover, const Plan& plan, const Bits& coded, const PlacementOptions& options,
                       const Progress& progress)
{
    const Surface& surface = cover.surface;
    const EdgeGraph graph = edge_graph(surface);
    const SolidTopology topology = solid_topology(surface);
    const Aim aim{options.strength, plan.options.as_printed ? 1 : 1.1, least_energy(surface)};
    PatchReading reading = read_with(surface, topology, graph, plan, checked_frame(surface.points, topology));
    const Frame first = reading.frame;
    const auto wanted = [&] { return bits_of_patches(reading, plan, coded); };
    check_patches(reading, wanted(), coded.size());

    Marking marking;
    marking.samples_min = poorest(reading, wanted());
    marking.capacity = std::min(most_carriers, plan.options.bits * marking.samples_min / vertices_of_a_shape);
    marking.kept.points = surface.points;
    const std::vector<double> before = margins_of(reading, wanted(), aim);
    if (*std::min_element(before.begin(), before.end()) >= 0) // the mark is there already
        return marking;

    Points points = surface.points;
    const auto propose = [&](int round) {
        reshape(reading, plan, wanted(), aim, cover, round == 1, points);
        Proposal proposal;
        proposal.guarded_vertices = plan.options.as_printed ? 0 : guard(cover, points);
        proposal.points = points;
        return proposal;
    };
    const HighPass filter = filter_of(graph);
    Points last = surface.points; // that were read
    const auto read = [&](const Points& stored, int) {
        const std::vector<int> moved = moved_vertices(last, stored);
        if (plan.options.as_printed || moved.size() > few * stored.size())
            reading = read_with({stored, surface.triangles}, topology, graph, plan,
                                turned_like(checked_frame(stored, topology), first));
        else
            read_moves(filter, graph, moved, last, stored, reading);
        last = stored;
        return margins_of(reading, wanted(), aim);
    };
    LoopResult loop = closed_loop(options.max_rounds, rounded_to_float, propose, read, "Shaping patches", progress);
    marking.kept = std::move(loop.kept);
    marking.rounds = loop.rounds;
    return marking;
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
            reading.erased.push_back(patch < 0);
        }
        readings.ways.push_back(std::move(reading));
    }
    readings.label_of_vertex = std::move(patches.patches.label);
    return readings;
}

MarkFrame find_spectral_copy(const Copy& copy, const Plan& /*plan*/)
{
    return checked_frame(copy.original.points, solid_topology(copy.original));
}

Readings read_spectral_copy(const Copy& copy, const Plan& plan, const MarkFrame& frame)
{
    const Frame& axes = std::get<Frame>(frame);
    const Surface& original = copy.original;
    const int count = static_cast<int>(plan.order.size());
    const Patches whole = equal_area_patches(original.points, solid_topology(original), edge_graph(original), axes,
                                             layers, count / layers, plan.trim);
    PatchReading reading;
    reading.patches = {whole.layers, whole.columns, {}};
    for (const Foot& foot : copy.feet()) {
        int nearest = 0;
        foot.weights.maxCoeff(&nearest);
        const bool stands = foot.face >= 0 && !foot.on_rim;
        reading.patches.label.push_back(stands ? whole.label[original.triangles[foot.face][nearest]] : -1);
    }
    reading.vertices = patch_vertices(reading.patches);
    reading.band = filtered(edge_graph(copy.laid()), about(axes.centre, copy.laid().points));
    for (const std::vector<int>& vertices : reading.vertices)
        reading.shapes.push_back(patch_shape(reading.band, vertices));
    reading.threshold = best_threshold(reading.shapes, vertices_of_a_shape);

    Reading way;
    way.label = carrying_patches(reading, plan, {false, false});
    way.label.resize(plan.options.bits);
    for (int& patch : way.label) {
        way.samples.push_back(patch >= 0 ? reading.shapes[patch].samples : 0);
        const bool held = way.samples.back() >= vertices_of_a_shape;
        way.soft.push_back(held ? reading.soft(patch) : 0);
        way.erased.push_back(!held);
    }
    Readings readings;
    readings.ways.push_back(std::move(way));
    readings.label_of_vertex = std::move(reading.patches.label);
    return readings;
}

} // namespace vcg_ext
