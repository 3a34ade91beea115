#include "spectral.h"

#include "../base/error.h"
#include "../base/parallel.h"
#include "../carrier/two_means.h"
#include "../geometry/chebyshev.h"
#include "../geometry/eigenbasis.h"
#include "../payload/binomial.h"
#include "../placement/fold_guard.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vcg_ext {

namespace {

constexpr int layers = 2;          // the thesis' kappa
constexpr double cutoff = 2;       // the highest 90 % of a mesh's eigenvalues
constexpr double high_share = 0.7; // the same, as the thesis prints it
constexpr double printed_threshold = 2.25;

} // namespace

PatchPlan patch_plan(const Key& key, int bits, double trim, bool as_printed)
{
    PatchPlan plan;
    plan.order = key.stream("patch-order").permutation(patch_count(bits, layers));
    plan.trim = trim >= 0 ? trim : static_cast<double>(key.stream("trim").below(15001)) / 1e5;
    plan.as_printed = as_printed;
    return plan;
}

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

Points filtered(const EdgeGraph& graph, const Points& points)
{
    const double bound = laplacian_bound(graph);
    return apply(high_pass(cutoff, bound, high_pass_degree(bound)), graph, points);
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

double best_threshold(const std::vector<PatchShape>& shapes)
{
    std::vector<double> ratios;
    for (const PatchShape& shape : shapes)
        ratios.push_back(std::log(shape.ratio()));
    return two_means(std::move(ratios));
}

PatchReading read_with(const Surface& surface, const EdgeGraph& graph, const PatchPlan& plan, const Frame* like)
{
    const int count = static_cast<int>(plan.order.size());
    PatchReading reading;
    reading.frame = principal_frame(surface);
    if (like)
        for (int k = 0; k < 3; ++k)
            if (reading.frame.axes.col(k).dot(like->axes.col(k)) < 0)
                reading.frame.axes.col(k) *= -1;
    reading.patches = plan.as_printed
                          ? thesis_patches(surface, reading.frame, layers, count, plan.trim)
                          : equal_area_patches(surface, graph, reading.frame, layers, count / layers, plan.trim);
    reading.vertices = patch_vertices(reading.patches);
    const Points local = about(reading.frame.centre, surface.points);
    reading.band = plan.as_printed ? exact_bands(graph, local, reading.vertices) : filtered(graph, local);
    reading.shapes.resize(reading.vertices.size());
    for_chunks(static_cast<int>(reading.vertices.size()), 1,
               [&](int k, int) { reading.shapes[k] = patch_shape(reading.band, reading.vertices[k]); });
    reading.threshold = plan.as_printed ? std::log(printed_threshold) : best_threshold(reading.shapes);
    return reading;
}

} // namespace

PatchReading read_patches(const Surface& surface, const PatchPlan& plan, const Frame* like)
{
    return read_with(surface, edge_graph(surface), plan, like);
}

std::vector<int> carrying_patches(const PatchReading& reading, const PatchPlan& plan, AxisFlips flips)
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
std::vector<AxisFlips> orientations(const PatchPlan& plan)
{
    if (plan.as_printed)
        return {{false, false}};
    return {{false, false}, {true, false}, {false, true}, {true, true}};
}

bool symmetric(const Frame& frame, int axis)
{
    // Noise, quantization, smoothing and simplification move bunny00's small one, 0.010, by at most 0.0016.
    constexpr double clear = 0.005;
    return std::abs(frame.third_moments[axis]) < clear * std::pow(frame.variances[axis], 1.5);
}

bool spare_bit(int number)
{
    return number % 2 == 1;
}

} // namespace

AxisFlips blind_orientation(const PatchReading& reading, const PatchPlan& plan, int bits)
{
    AxisFlips best;
    double most = -std::numeric_limits<double>::infinity();
    for (const AxisFlips flips : orientations(plan)) {
        if ((flips.first && !symmetric(reading.frame, 0)) || (flips.second && !symmetric(reading.frame, 1)))
            continue;
        const std::vector<int> patches = carrying_patches(reading, plan, flips);
        double agreement = 0;
        for (int i = bits; i < static_cast<int>(patches.size()); ++i)
            if (patches[i] >= 0)
                agreement += spare_bit(i - bits) ? reading.soft(patches[i]) : -reading.soft(patches[i]);
        if (agreement > most) {
            most = agreement;
            best = flips;
        }
    }
    return best;
}

namespace {

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

Points vertex_normals(const Surface& surface)
{
    Points normals(surface.points.size(), Point::Zero());
    for (const Triangle& t : surface.triangles) {
        const Point n = scaled_normal(surface.points, t);
        for (const int v : t)
            normals[v] += n;
    }
    for (Point& n : normals)
        n.normalize();
    return normals;
}

/// The energy above which noise and quantization of the usual strengths leave a ratio to be read: 1.6e-3 of the
/// diagonal squared, but never more than three tenths of an edge.
double least_energy(const Surface& surface)
{
    const double edges = ordered_sum(static_cast<int>(surface.triangles.size()), 0.0, [&](int f) {
        const Triangle& t = surface.triangles[f];
        return (surface.points[t[0]] - surface.points[t[1]]).norm() +
               (surface.points[t[1]] - surface.points[t[2]]).norm() +
               (surface.points[t[2]] - surface.points[t[0]]).norm();
    });
    const double edge = edges / (3.0 * static_cast<double>(surface.triangles.size()));
    return std::pow(std::min(1.6e-3 * bounding_diagonal(surface), 0.3 * edge), 2);
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
std::vector<int> bits_of_patches(const PatchReading& reading, const PatchPlan& plan, const Bits& bits)
{
    std::vector<int> result(reading.patches.count(), -1);
    const std::vector<int> patches = carrying_patches(reading, plan, {});
    for (std::size_t i = 0; i < patches.size(); ++i)
        if (patches[i] >= 0 && i < bits.size())
            result[patches[i]] = bits[i];
        else if (patches[i] >= 0 && !plan.as_printed)
            result[patches[i]] = spare_bit(static_cast<int>(i - bits.size()));
    return result;
}

Bits exclusive_or(Bits bits, const Bits& mask)
{
    for (std::size_t i = 0; i < bits.size(); ++i)
        bits[i] ^= mask[i];
    return bits;
}

/// Moves the vertices of the patches that lack margin; all but those that fulfil their condition `at_first`.
void reshape(const PatchReading& reading, const PatchPlan& plan, const std::vector<int>& wanted, const Aim& aim,
             const Points& normals, bool at_first, Points& points)
{
    for_chunks(static_cast<int>(wanted.size()), 1, [&](int k, int) {
        const PatchShape& shape = reading.shapes[k];
        const std::vector<int>& vertices = reading.vertices[k];
        if (wanted[k] < 0 || (!at_first && aim.margin(wanted[k], shape) >= 0))
            return;
        const bool squash = wanted[k] == 1;
        const double ratio = squash ? aim.ratio : aim.round;
        const Points moves = plan.as_printed ? printed_change(shape, reading.band, vertices, ratio)
                                             : least_change(shape, reading.band, normals, vertices, squash, ratio,
                                                            squash ? aim.energy : aim.energy / 4);
        for (std::size_t i = 0; i < moves.size(); ++i)
            points[vertices[i]] += moves[i];
    });
}

double worst_margin(const PatchReading& reading, const std::vector<int>& wanted, const Aim& aim)
{
    double worst = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < wanted.size(); ++k)
        if (wanted[k] >= 0)
            worst = std::min(worst, aim.margin(wanted[k], reading.shapes[k]));
    return worst;
}

constexpr int vertices_of_a_shape = 8; ///< at least

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
        throw Error("The mesh has " + std::to_string(bits.size()) + " patches for " + std::to_string(wanted) +
                    " bits.");
    for (std::size_t k = 0; k < bits.size(); ++k)
        if (bits[k] >= 0 && reading.shapes[k].samples < vertices_of_a_shape)
            throw Error("A patch holds " + std::to_string(reading.shapes[k].samples) + " vertices, and " +
                        std::to_string(vertices_of_a_shape) + " are the fewest that have a shape.");
}

} // namespace

Points embed_spectral(const Cover& cover, const PatchPlan& plan, const Bits& mask, const EmbedOptions& options,
                      const std::function<Points(const Points&)>& round, EmbedReport& result, const Progress& progress)
{
    const Surface& surface = cover.surface;
    const EdgeGraph graph = edge_graph(surface);
    const Points normals = vertex_normals(surface);
    const Aim aim{result.strength, plan.as_printed ? 1 : 1.1, least_energy(surface)};
    const Bits bits = exclusive_or(result.bits, mask);
    PatchReading reading = read_with(surface, graph, plan, nullptr);
    const Frame first = reading.frame;
    check_patches(reading, bits_of_patches(reading, plan, bits), bits.size());

    const auto count_vertices = [&] {
        result.samples_min = poorest(reading, bits_of_patches(reading, plan, bits));
        result.capacity = std::min(most_bits, options.bits * result.samples_min / vertices_of_a_shape);
    };

    Points points = surface.points;
    Points best = points;
    double best_margin = worst_margin(reading, bits_of_patches(reading, plan, bits), aim);
    count_vertices();
    if (best_margin < 0) // else the mark is there already
        best_margin = -std::numeric_limits<double>::infinity();
    for (int r = 1; r <= options.max_rounds && best_margin < 0; ++r) {
        report(progress, 20 + 60 * (r - 1) / options.max_rounds, "Shaping patches");
        reshape(reading, plan, bits_of_patches(reading, plan, bits), aim, normals, r == 1, points);
        const int guarded = plan.as_printed ? 0 : guard(cover, points);
        reading = read_with({round(points), surface.triangles}, graph, plan, &first);
        const double margin = worst_margin(reading, bits_of_patches(reading, plan, bits), aim);
        if (margin > best_margin) {
            best_margin = margin;
            best = points;
            result.guarded_vertices = guarded;
            count_vertices();
        }
        result.rounds = r;
    }
    return best;
}

namespace {

Bits read_bits(const PatchReading& reading, const std::vector<int>& patches, const Bits& mask)
{
    Bits bits(mask.size());
    for (std::size_t i = 0; i < mask.size(); ++i)
        bits[i] = static_cast<std::uint8_t>((patches[i] >= 0 && reading.soft(patches[i]) > 0) ^ mask[i]);
    return bits;
}

std::vector<int> bits_of_vertices(const PatchReading& reading, const std::vector<int>& patches, std::size_t bits)
{
    std::vector<int> bit_of_patch(reading.patches.count(), -1);
    for (std::size_t i = 0; i < bits; ++i)
        if (patches[i] >= 0)
            bit_of_patch[patches[i]] = static_cast<int>(i);
    std::vector<int> result = reading.patches.label;
    for (int& label : result)
        if (label >= 0)
            label = bit_of_patch[label];
    return result;
}

AxisFlips best_match(const PatchReading& reading, const PatchPlan& plan, const Bits& mask, const Bits& expected)
{
    AxisFlips best;
    int most = -1;
    for (const AxisFlips flips : orientations(plan)) {
        const int matches = matching_bits(expected, read_bits(reading, carrying_patches(reading, plan, flips), mask));
        if (matches > most) {
            most = matches;
            best = flips;
        }
    }
    return best;
}

} // namespace

int detect_spectral(const Surface& surface, const PatchPlan& plan, const Bits& mask, const DetectOptions& options,
                    DetectReport& result)
{
    const int bits = static_cast<int>(mask.size());
    const PatchReading reading = read_patches(surface, plan);
    const AxisFlips flips = options.expected ? best_match(reading, plan, mask, pad_message(*options.expected, bits))
                                             : blind_orientation(reading, plan, bits);
    const std::vector<int> patches = carrying_patches(reading, plan, flips);
    result.bits = read_bits(reading, patches, mask);
    for (int i = 0; i < bits; ++i) {
        const double soft = patches[i] >= 0 ? reading.soft(patches[i]) : 0;
        result.soft.push_back(mask[i] ? -soft : soft);
        result.samples.push_back(patches[i] >= 0 ? reading.shapes[patches[i]].samples : 0);
    }
    result.carrier_of_vertex = bits_of_vertices(reading, patches, mask.size());
    result.orientation = {flips.first ? '-' : '+', flips.second ? '-' : '+'};
    return static_cast<int>(orientations(plan).size());
}

} // namespace vcg_ext
