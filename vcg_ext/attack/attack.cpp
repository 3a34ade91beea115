// SPDX-License-Identifier: GPL-3.0-or-later
#include "attack.h"

#include "../base/check.h"
#include "../base/progress.h"
#include "../base/text.h"
#include "../base/weld.h"
#include "../geometry/size.h"
#include "affine.h"
#include "crop.h"
#include "isosurface.h"
#include "loop.h"
#include "mirror.h"
#include "noise.h"
#include "plate.h"
#include "quantize.h"
#include "remesh.h"
#include "reorder.h"
#include "resample.h"
#include "similarity.h"
#include "simplify.h"
#include "smooth.h"
#include "sqrt3.h"
#include "subdivide.h"

#include <cmath>

namespace vcg_ext {

namespace {

/// Gives the attacked surface; welds what needs it.
using Work = Surface (*)(const Surface&, const AttackReport&, const Progress&);

struct Row {
    Attack attack;
    const char* name;
    AttackRange range;
    Work work;
};

Surface with_positions(const Surface& surface, Points points)
{
    return {std::move(points), surface.triangles};
}

std::size_t part(double amount, std::size_t count)
{
    return static_cast<std::size_t>(std::floor(amount * static_cast<double>(count) + 0.5));
}

AttackRange moves(const char* amount_is, double amount, double least, double most)
{
    AttackRange range;
    range.amount_is = amount_is;
    range.amount = amount;
    range.least = least;
    range.most = most;
    range.positions_only = true;
    return range;
}

AttackRange rebuilds(const char* amount_is, double amount, double least, double most)
{
    AttackRange range = moves(amount_is, amount, least, most);
    range.positions_only = false;
    return range;
}

AttackRange seeded(AttackRange range)
{
    range.seeded = true;
    return range;
}

AttackRange repeated(AttackRange range, int iterations, int most)
{
    range.iterations = iterations;
    range.most_iterations = most;
    return range;
}

AttackRange whole(AttackRange range)
{
    range.whole = true;
    return range;
}

const std::vector<Row>& rows()
{
    static const std::vector<Row> table = {
        {Attack::Noise, "Noise", seeded(moves("displacement over the farthest norm", 0.003, 0, 0.1)),
         [](const Surface& s, const AttackReport& r, const Progress&) {
             return with_positions(s, noise(s, r.amount, r.seed));
         }},
        {Attack::Smooth, "Smooth",
         repeated(moves("lambda, the part of the way to the neighbours' mean", 0.5, 0, 1), 10, 1000),
         [](const Surface& s, const AttackReport& r, const Progress& progress) {
             return with_positions(s, smooth(s, r.amount, r.iterations, progress));
         }},
        {Attack::Simplify, "Simplify", rebuilds("part of the faces removed", 0.5, 0, 0.999),
         [](const Surface& s, const AttackReport& r, const Progress& progress) {
             const Surface welded = weld(s).surface;
             const std::size_t faces = welded.triangles.size();
             return simplify(welded, static_cast<int>(faces - part(r.amount, faces)), progress);
         }},
        {Attack::Quantize, "Quantize", whole(moves("bits per axis", 8, 2, 24)),
         [](const Surface& s, const AttackReport& r, const Progress&) {
             return with_positions(s, quantize(s.points, static_cast<int>(r.amount)));
         }},
        {Attack::Resample, "Resample", rebuilds("vertices kept, as a part", 0.5, 0.01, 4),
         [](const Surface& s, const AttackReport& r, const Progress& progress) {
             const Surface welded = weld(s).surface;
             return resample(welded, static_cast<int>(part(r.amount, welded.points.size())), progress);
         }},
        {Attack::Remesh, "Remesh",
         repeated(rebuilds("target edge length over the mean edge length", 1, 0.2, 10), 10, 100),
         [](const Surface& s, const AttackReport& r, const Progress& progress) {
             const Surface welded = weld(s).surface;
             return remesh(welded, r.amount * mean_edge_length(welded), r.iterations, progress);
         }},
        {Attack::Isosurface, "Isosurface", rebuilds("cell size over the bounding box's diagonal", 0.005, 0.002, 0.1),
         [](const Surface& s, const AttackReport& r, const Progress& progress) {
             const Surface welded = weld(s).surface;
             return isosurface(welded, r.amount * bounding_diagonal(welded), progress);
         }},
        {Attack::Subdivide, "Subdivide", repeated(AttackRange(), 1, 6),
         [](const Surface& s, const AttackReport& r, const Progress& progress) {
             return subdivide(weld(s).surface, r.iterations, progress);
         }},
        {Attack::Crop, "Crop", seeded(rebuilds("part of the faces removed", 0.3, 0, 0.95)),
         [](const Surface& s, const AttackReport& r, const Progress&) { return crop(s, r.amount, r.seed); }},
        {Attack::Similarity, "Similarity", seeded(moves(nullptr, 0, 0, 0)),
         [](const Surface& s, const AttackReport& r, const Progress&) {
             return with_positions(s, similarity(s.points, r.seed));
         }},
        {Attack::Affine, "Affine", seeded(moves("largest relative stretch or shear", 0.1, 0, 0.5)),
         [](const Surface& s, const AttackReport& r, const Progress&) {
             return with_positions(s, affine(s.points, r.amount, r.seed));
         }},
        {Attack::Reorder, "Reorder", seeded(AttackRange()),
         [](const Surface& s, const AttackReport& r, const Progress&) { return reorder(s, r.seed); }},
        {Attack::Taubin, "Taubin",
         repeated(moves("lambda of the step inwards, 1.06 of it outwards", 0.5, 0, 1), 10, 1000),
         [](const Surface& s, const AttackReport& r, const Progress& progress) {
             return with_positions(s, smooth_by_taubin(s, r.amount, r.iterations, progress));
         }},
        {Attack::Loop, "Loop", repeated(AttackRange(), 1, 6),
         [](const Surface& s, const AttackReport& r, const Progress& progress) {
             return subdivide_by_loop(weld(s).surface, r.iterations, progress);
         }},
        {Attack::Sqrt3, "Sqrt3", repeated(AttackRange(), 1, 8),
         [](const Surface& s, const AttackReport& r, const Progress& progress) {
             return subdivide_by_sqrt3(weld(s).surface, r.iterations, progress);
         }},
        {Attack::Mirror, "Mirror", AttackRange(),
         [](const Surface& s, const AttackReport&, const Progress&) { return mirror(s); }},
        {Attack::Plate, "Plate", seeded(whole(rebuilds("copies", 4, 2, 64))),
         [](const Surface& s, const AttackReport& r, const Progress&) {
             return plate(s, static_cast<int>(r.amount), r.seed);
         }},
    };
    return table;
}

const Row& row(Attack attack)
{
    const auto at = static_cast<std::size_t>(attack);
    if (at >= rows().size())
        throw Error("There is no attack number " + std::to_string(at) + ".");
    return rows()[at];
}

double checked_amount(const Row& row, double amount)
{
    const AttackRange& r = row.range;
    if (!r.amount_is)
        return 0;
    if (amount == -1)
        return r.amount;
    if (!(amount >= r.least && amount <= r.most) || (r.whole && amount != std::floor(amount)))
        throw Error("Amount is " + text(amount) + ", but for " + row.name + " it is the " + r.amount_is +
                    " and must be " + (r.whole ? "a whole number " : "") + "between " + text(r.least) + " and " +
                    text(r.most) + ", or -1 for " + text(r.amount) + ".");
    return amount;
}

int checked_iterations(const Row& row, int iterations)
{
    const AttackRange& r = row.range;
    if (r.iterations == 0)
        return 0;
    if (iterations == -1)
        return r.iterations;
    if (iterations < 1 || iterations > r.most_iterations)
        throw Error("Iterations is " + std::to_string(iterations) + ", but for " + row.name +
                    " it must be between 1 and " + std::to_string(r.most_iterations) + ", or -1 for " +
                    std::to_string(r.iterations) + ".");
    return iterations;
}

} // namespace

const std::vector<Attack>& all_attacks()
{
    static const std::vector<Attack> all = [] {
        std::vector<Attack> attacks;
        for (const Row& row : rows())
            attacks.push_back(row.attack);
        return attacks;
    }();
    return all;
}

const char* name(Attack attack)
{
    return row(attack).name;
}

const AttackRange& range(Attack attack)
{
    return row(attack).range;
}

AttackReport apply_attack(Surface& surface, const AttackOptions& options, const Progress& progress)
{
    const Row& attack = row(options.attack);
    AttackReport result;
    result.attack = options.attack;
    result.amount = checked_amount(attack, options.amount);
    result.iterations = checked_iterations(attack, options.iterations);
    result.seed = options.seed;
    result.positions_only = attack.range.positions_only;

    report(progress, 0, attack.name);
    check_surface(surface);
    Surface attacked = attack.work(surface, result, progress);
    report(progress, 100, attack.name);
    if (attacked.triangles.empty())
        throw Error(std::string(attack.name) + " would leave no face of the mesh. Choose a weaker attack.");
    result.vertices = static_cast<int>(attacked.points.size());
    result.faces = static_cast<int>(attacked.triangles.size());
    surface = std::move(attacked);
    return result;
}

} // namespace vcg_ext
