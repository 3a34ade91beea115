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
#include <optional>
#include <utility>

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

Points about(const Point& centre, Points points)
{
    for_each_index(static_cast<int>(points.size()), [&](int v) { points[v] -= centre; });
    return points;
}

HighPass filter_of(const EdgeGraph& graph)
{
    const double bound = laplacian_bound(graph);
    return high_pass(cutoff, bound, high_pass_degree(bound));
}

Points filtered(const EdgeGraph& graph, Points points)
{
    return apply(filter_of(graph), graph, std::move(points));
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

/// The patches alone, not what is in them.
PatchReading cut_patches(const Points& points, const SolidTopology& topology, const EdgeGraph& graph, const Plan& plan,
                         const Frame& frame)
{
    const int count = static_cast<int>(plan.order.size());
    PatchReading reading;
    reading.frame = frame;
    reading.patches = plan.options.as_printed
                          ? thesis_patches(points, topology, frame, layers, count, plan.trim)
                          : equal_area_patches(points, topology, graph, frame, layers, count / layers, plan.trim);
    reading.vertices = patch_vertices(reading.patches);
    return reading;
}

void read_bands(Points points, const EdgeGraph& graph, const Plan& plan, PatchReading& reading)
{
    const bool as_printed = plan.options.as_printed;
    points = about(reading.frame.centre, std::move(points));
    reading.band = as_printed ? exact_bands(graph, points, reading.vertices) : filtered(graph, std::move(points));
    measure_shapes(reading);
    reading.threshold = as_printed ? std::log(printed_threshold) : best_threshold(reading.shapes);
}

} // namespace

PatchReading read_patches(const Surface& surface, const Plan& plan, const Frame& frame)
{
    const EdgeGraph graph = edge_graph(surface);
    PatchReading reading = cut_patches(surface.points, solid_topology(surface), graph, plan, frame);
    read_bands(surface.points, graph, plan, reading);
    return reading;
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

/// The vertices of some patches, which are about to move.
/// \param chosen per patch
Moves moves_of(const PatchReading& reading, const std::vector<char>& chosen, const Points& points)
{
    const std::vector<int>& label = reading.patches.label;
    Moves moves;
    moves.vertices =
        indices_where(static_cast<int>(label.size()), [&](int v) { return label[v] >= 0 && chosen[label[v]] != 0; });
    moves.before.resize(moves.vertices.size());
    for_each_index(static_cast<int>(moves.vertices.size()),
                   [&](int i) { moves.before[i] = points[moves.vertices[i]]; });
    return moves;
}

/// Takes moves back by halves where a face would fold, those of earlier rounds too.
/// \param moved in this round
Moves guard(const Cover& cover, const std::vector<int>& moved, Points& points)
{
    constexpr int steps = 8;
    return guard_folds(cover, points, folded_faces(cover, points, {}, moved), steps,
                       [&](int v, int) -> Point { return (points[v] + cover.points[v]) / 2; });
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

/// Per patch whether it lacks margin; `at_first` whether it carries something: least_change() leaves it where all is well.
std::vector<char> patches_to_shape(const PatchReading& reading, const std::vector<int>& wanted, const Aim& aim,
                                   bool at_first)
{
    std::vector<char> result(wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k)
        result[k] = wanted[k] >= 0 && (at_first || aim.margin(wanted[k], reading.shapes[k]) < 0);
    return result;
}

void reshape(const PatchReading& reading, const Plan& plan, const std::vector<int>& wanted,
             const std::vector<char>& chosen, const Aim& aim, const Cover& cover, Points& points)
{
    for_chunks(static_cast<int>(wanted.size()), 1, [&](int k, int) {
        if (!chosen[k])
            return;
        const PatchShape& shape = reading.shapes[k];
        const std::vector<int>& vertices = reading.vertices[k];
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

Point rounded(const Point& point)
{
    return point.cast<float>().cast<double>();
}

/// Takes up what moves do to the bands; the cuts stay.
void read_moves(const HighPass& filter, const EdgeGraph& graph, const Moves& moves, const Points& points,
                PatchReading& reading)
{
    std::vector<int> moved;
    Points steps;
    for (std::size_t i = 0; i < moves.vertices.size(); ++i) {
        const int v = moves.vertices[i];
        const Point step = rounded(points[v]) - rounded(moves.before[i]);
        if (step.isZero(0))
            continue;
        moved.push_back(v);
        steps.push_back(step);
    }
    add_band_of_moves(filter, graph, moved, steps, reading.band);
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
    const EdgeGraph graph = edge_graph(cover.around, cover.triangles);
    const bool as_printed = plan.options.as_printed;
    const Aim aim{options.strength, as_printed ? 1 : 1.1, least_energy(surface)};
    std::optional<Frame> first;
    const auto read_anew = [&](Points points) {
        PatchReading reading;
        {
            const SolidTopology topology = solid_topology(surface);
            const Frame frame = checked_frame(points, topology);
            reading = cut_patches(points, topology, graph, plan, first ? turned_like(frame, *first) : frame);
        }
        read_bands(std::move(points), graph, plan, reading);
        return reading;
    };
    PatchReading reading = read_anew(surface.points);
    first = reading.frame;
    const auto wanted = [&] { return bits_of_patches(reading, plan, coded); };
    check_patches(reading, wanted(), coded.size());

    Marking marking;
    marking.samples_min = poorest(reading, wanted());
    marking.capacity = std::min(most_carriers, plan.options.bits * marking.samples_min / vertices_of_a_shape);
    const auto worst_margin = [&] {
        const std::vector<double> margins = margins_of(reading, wanted(), aim);
        return *std::min_element(margins.begin(), margins.end());
    };
    Points& points = marking.kept.points = copy_of(surface.points);
    if (worst_margin() >= 0) // the mark is there already
        return marking;

    const HighPass filter = filter_of(graph);
    int guarded = 0;
    std::vector<Moves> since_best;
    const auto shape_and_read = [&](int round) {
        const std::vector<char> chosen = patches_to_shape(reading, wanted(), aim, round == 1);
        Moves moves = moves_of(reading, chosen, points);
        reshape(reading, plan, wanted(), chosen, aim, cover, points);
        const Moves back = as_printed ? Moves() : guard(cover, moves.vertices, points);
        guarded = static_cast<int>(back.vertices.size());
        moves = round == 1 ? Moves() : joined(moves, back); // after the first there is nothing better to go back to
        if (as_printed || round == 1 || moves.vertices.size() > few * points.size()) {
            reading = {};
            reading = read_anew(rounded_to_float(points));
        } else
            read_moves(filter, graph, moves, points, reading);
        since_best.push_back(std::move(moves));
        return worst_margin();
    };
    marking.rounds = closed_loop(options.max_rounds, "Shaping patches", progress, shape_and_read, [&] {
        marking.kept.guarded_vertices = guarded;
        since_best.clear();
    });
    for (; !since_best.empty(); since_best.pop_back())
        take_back(since_best.back(), points);
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
    }
    Readings readings;
    readings.ways.push_back(std::move(way));
    readings.label_of_vertex = std::move(reading.patches.label);
    return readings;
}

} // namespace vcg_ext
