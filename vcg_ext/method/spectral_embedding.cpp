// SPDX-License-Identifier: GPL-3.0-or-later
#include "spectral.h"

#include "../base/parallel.h"
#include "../geometry/size.h"
#include "../placement/fold_guard.h"
#include "closed_loop.h"
#include "patch_reading.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace vcg_ext {

namespace {

constexpr double few = 0.2; // of the vertices: where no more moved in a round, they move no cut to speak of

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

/// The cover while its patches get their shapes, as the detector reads it after each round.
class PatchShaping {
public:
    /// \throw DoesNotFit where patches are too small or too few
    PatchShaping(const Cover& cover, const Plan& plan, const Bits& coded, double strength)
        : cover_(cover), plan_(plan), coded_(coded), graph_(edge_graph(cover.around, cover.triangles)),
          filter_(patch_filter(graph_)), aim_{strength, plan.options.as_printed ? 1 : 1.1, least_energy(cover.surface)},
          points_(copy_of(cover.surface.points))
    {
        read_anew(cover.surface.points);
        first_ = reading_.frame;
        check_patches(reading_, wanted(), coded.size());
    }

    /// Vertices of the smallest patch that carries something.
    [[nodiscard]] int fewest_samples() const
    {
        return least_of<int>([](const PatchShape& shape, bool) { return shape.samples; });
    }

    /// Of the patch that most wants another round; negative where it does.
    [[nodiscard]] double worst_margin() const
    {
        return least_of<double>([&](const PatchShape& shape, bool bit) { return aim_.margin(bit, shape); });
    }

    /// One round. \return worst_margin()
    double shape(int round)
    {
        const bool as_printed = plan_.options.as_printed;
        const std::vector<int> bits = wanted();
        const std::vector<char> chosen = patches_to_shape(reading_, bits, aim_, round == 1);
        Moves moves = moves_of(reading_, chosen, points_);
        reshape(reading_, plan_, bits, chosen, aim_, cover_, points_);
        const Moves back = as_printed ? Moves() : guard(cover_, moves.vertices, points_);
        guarded_ = static_cast<int>(back.vertices.size());
        moves = round == 1 ? Moves() : joined(moves, back); // after the first there is nothing better to go back to
        if (as_printed || round == 1 || moves.vertices.size() > few * points_.size())
            read_anew(rounded_to_float(points_));
        else
            read_moves(filter_, graph_, moves, points_, reading_);
        since_best_.push_back(std::move(moves));
        return worst_margin();
    }

    /// The last round is the best so far.
    void keep(Proposal& kept)
    {
        kept.guarded_vertices = guarded_;
        since_best_.clear();
    }

    /// The positions of the best round; to be called once.
    [[nodiscard]] Points best()
    {
        for (; !since_best_.empty(); since_best_.pop_back())
            take_back(since_best_.back(), points_);
        return std::move(points_);
    }

private:
    void read_anew(Points points)
    {
        reading_ = {}; // before the next one takes as much
        {
            const SolidTopology topology = solid_topology(cover_.surface);
            const Frame frame = patch_frame(points, topology);
            reading_ = cut_patches(points, topology, graph_, plan_, first_ ? turned_like(frame, *first_) : frame);
        }
        read_bands(std::move(points), graph_, plan_, reading_);
    }

    [[nodiscard]] std::vector<int> wanted() const { return bits_of_patches(reading_, plan_, coded_); }

    /// The least of `value(shape, bit)` of the patches that carry something.
    template <class Value, class Of>
    [[nodiscard]] Value least_of(const Of& value) const
    {
        const std::vector<int> bits = wanted();
        Value least = std::numeric_limits<Value>::max();
        for (std::size_t k = 0; k < bits.size(); ++k)
            if (bits[k] >= 0)
                least = std::min(least, value(reading_.shapes[k], bits[k] != 0));
        return least;
    }

    const Cover& cover_;
    const Plan& plan_;
    const Bits& coded_;
    EdgeGraph graph_;
    HighPass filter_;
    Aim aim_;
    Points points_;
    std::optional<Frame> first_; ///< the cover's
    PatchReading reading_;
    int guarded_ = 0;
    std::vector<Moves> since_best_;
};

} // namespace

Marking embed_spectral(const Cover& cover, const Plan& plan, const Bits& coded, const PlacementOptions& options,
                       const Progress& progress)
{
    PatchShaping shaping(cover, plan, coded, options.strength);
    Marking marking;
    marking.samples_min = shaping.fewest_samples();
    marking.capacity = std::min(most_carriers, plan.options.bits * marking.samples_min / vertices_of_a_shape);
    if (shaping.worst_margin() < 0) // else the mark is there already
        marking.rounds = closed_loop(
            options.max_rounds, "Shaping patches", progress, [&](int round) { return shaping.shape(round); },
            [&] { shaping.keep(marking.kept); });
    marking.kept.points = shaping.best();
    return marking;
}

} // namespace vcg_ext
