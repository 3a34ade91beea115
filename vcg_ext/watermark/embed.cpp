// SPDX-License-Identifier: GPL-3.0-or-later
#include "embed.h"

#include "../base/check.h"
#include "../base/parallel.h"
#include "../base/stopwatch.h"
#include "../base/text.h"
#include "../geometry/body.h"
#include "../geometry/normals.h"
#include "../geometry/size.h"
#include "../geometry/solid.h"
#include "../method/methods.h"
#include "../metric/bend.h"
#include "../metric/displacement.h"
#include "../payload/code.h"
#include "detect.h"
#include "secrets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace vcg_ext {

namespace {

constexpr double visible = 5e-4; ///< MRMS over the diagonal

EmbedOptions completed(EmbedOptions options, std::size_t vertices)
{
    options.carriers.check();
    options.placement.check();
    if (options.carriers.bits == 0)
        options.carriers.bits = recommended_carriers(options.message);
    if (!options.held.empty() && options.held.size() != vertices)
        throw Error("Vertices that are held must be said for each vertex, or for none.");
    options.placement.strength = checked_strength(options.carriers, options.placement.strength);
    return options;
}

/// Puts one layer on the cover.
Marking mark(const Cover& cover, const Key& key, const MethodRow& method, const EmbedOptions& options,
             const Bits& coded, double strength, double& trim, const Progress& progress)
{
    CarrierOptions carriers = options.carriers;
    carriers.method = method.method;
    PlacementOptions placement = options.placement;
    if (strength > 0)
        placement.strength = strength;
    const Plan plan = method.plan(key, carriers);
    trim = std::max(trim, plan.trim);
    return method.embed(cover, plan, masked(coded, bit_mask(key, method.secret, carriers.bits)), placement, progress);
}

/// Takes over what a layer reports; those after the first add to it.
void take_up(const Marking& marking, EmbedReport& result)
{
    const bool first = result.layers.size() == 1;
    if (marking.samples_min > 0)
        result.samples_min = marking.samples_min;
    result.capacity = first ? marking.capacity : std::min(result.capacity, marking.capacity);
    result.rounds += marking.rounds;
    result.guarded_vertices += marking.kept.guarded_vertices;
    if (marking.kept.solver)
        result.solver = marking.kept.solver;
    if (marking.kept.moves)
        result.moves = marking.kept.moves;
    result.warnings.insert(result.warnings.end(), marking.warnings.begin(), marking.warnings.end());
}

/// Reads back what was embedded, layer by layer: the part of the carriers that hold their bits. Blind, unless the
/// body's ends can only be told apart by the message.
double self_check(const Body& marked, const Key& key, const EmbedOptions& options, EmbedReport& result,
                  const Progress& progress)
{
    const auto quietly = [&progress](int, const char*) { return !progress || progress(85, "Checking blind"); };
    double worst = 1;
    for (const Method layer : result.layers) {
        DetectOptions blind{options.carriers, {}};
        blind.carriers.method = layer;
        if (detect_whole(marked, key, blind, 1, quietly).bits == result.bits)
            continue;
        blind.expected = {options.message};
        const double ratio = *detect_whole(marked, key, blind, 1, quietly).detection_ratio;
        if (ratio == 1)
            result.warnings.emplace_back(
                "The body is so symmetric that with this key the message can only be read by who knows what to expect. "
                "Set it for detection too, or take another key.");
        worst = std::min(worst, ratio);
    }
    return worst;
}

/// What two hold changes places as long as this lives.
class Exchange {
public:
    Exchange(Points& one, Points& other) : one_(one), other_(other) { one_.swap(other_); }
    ~Exchange() { one_.swap(other_); }
    Exchange(const Exchange&) = delete;
    Exchange& operator=(const Exchange&) = delete;

private:
    Points& one_;
    Points& other_;
};

/// All layers of the method, the one on top of the other, so far as each leaves those below it readable.
/// \param body   as it is again afterwards; `around` are the faces around its sites
/// \param check  of positions with `result.layers` on them: the part of the carriers that hold their bits
/// \return the positions, which are those that were checked last
Points put_on(Body& body, const std::shared_ptr<const VertexFaces>& around, const std::vector<char>& held,
              const Key& key, const EmbedOptions& options, const Bits& coded, EmbedReport& result,
              const std::function<double(const Points&)>& check, const Progress& progress)
{
    const MethodRow& wanted = row_of(options.carriers.method);
    Points first; // with the first layer: what those above cover
    std::string refusals;
    const auto mark_with = [&](const MethodRow& method, double strength) {
        return mark(Cover(body.surface, held, around), key, method, options, coded, strength, result.trim, progress);
    };
    const auto mark_on_first = [&](const MethodRow& method, double strength) {
        const Exchange exchange(body.surface.points, first);
        return mark_with(method, strength);
    };
    for (std::size_t i = 0; i < wanted.layers.size(); ++i) {
        const auto& [method, strength] = wanted.layers[i];
        try {
            Marking marking = i == 0 ? mark_with(row_of(method), strength) : mark_on_first(row_of(method), strength);
            result.layers.push_back(method);
            if (i > 0 && check(marking.kept.points) < 1)
                throw Error("It would not read back, or spoil what lies below.");
            take_up(marking, result);
            if (i > 0)
                return std::move(marking.kept.points);
            first = std::move(marking.kept.points);
        } catch (const Cancelled&) {
            throw;
        } catch (const Error& error) {
            if (i == 0)
                throw;
            result.layers.resize(1);
            refusals += std::string(" ") + name(method) + ": " + error.what();
        }
    }
    if (!refusals.empty())
        result.warnings.push_back(std::string("Only ") + name(result.layers.front()) +
                                  " fits on this mesh, so strong noise and coarse quantization will erase the mark." +
                                  refusals);
    if (check(first) < 1)
        throw DoesNotFit("The blind self-check did not read every bit back.", result.capacity);
    return first;
}

std::vector<char> held_sites(const Body& body, const std::vector<char>& held)
{
    std::vector<char> result(held.empty() ? 0 : body.surface.points.size(), 0);
    for (std::size_t v = 0; v < held.size(); ++v)
        if (held[v] && body.site_of_vertex[v] >= 0)
            result[body.site_of_vertex[v]] = 1;
    return result;
}

/// What a reader has to set, in one sentence.
std::string recipe_of(const EmbedOptions& options)
{
    const MethodRow& method = row_of(options.carriers.method);
    std::string recipe = std::string("read it with Method ") + method.name;
    if (method.has_statistic)
        recipe += std::string(", Statistic ") + name(options.carriers.statistic);
    recipe += ", Bits " + std::to_string(options.carriers.bits);
    recipe += options.carriers.trim < 0 ? ", Trim drawn from the key (-1)" : ", Trim " + text(options.carriers.trim);
    return recipe + ".";
}

/// What a surface that is not one closed piece means for its mark.
void warn_of_shape(const Body& body, EmbedReport& result)
{
    if (const std::string loose = about_loose_pieces(body); !loose.empty())
        result.warnings.push_back(loose);
    if (const int parts = body.pieces - body.loose_pieces; parts > 1)
        result.warnings.push_back("The mesh is " + std::to_string(parts) +
                                  " separate pieces, marked as one body: taking some of them away loses the mark.");
    if (body.closed)
        return;
    const HoleFans holes = hole_fans(body.surface);
    if (holes.apexes == 0)
        return;
    const double closing = surface_area({solid_points(holes, body.surface.points), holes.fans});
    const double share = closing / (closing + surface_area(body.surface));
    if (share > 0.01)
        result.warnings.push_back("The mesh is open: its holes would take " + text(std::round(100 * share)) +
                                  " % of its surface. Filling them later keeps the mark, cutting more away does not.");
}

void warn(const EmbedOptions& options, EmbedReport& result)
{
    if (options.message.kind != Kind::Bits && clean_log_p(options.message, options.carriers.bits) > -6)
        result.warnings.push_back("With " + std::to_string(options.carriers.bits) +
                                  " bits nobody can prove this message with the key alone, only who knows what to "
                                  "expect. Set Bits to 0, or to " +
                                  std::to_string(recommended_carriers(options.message)) + ".");
    if (options.message.kind == Kind::Bits && options.carriers.bits < 20)
        result.warnings.emplace_back("Fewer than 20 bits can never prove anything: they match by chance too often.");
    if (result.mrms_relative > visible)
        result.warnings.push_back("The mark moves the surface by " +
                                  text(std::round(1e5 * result.mrms_relative) / 1e5) +
                                  " of the diagonal (MRMS): it will show. Lower Strength, or take more Bits.");
}

/// Two numbers of carriers that a mesh may have a place for which has none for `wanted`.
/// \param roomy see DoesNotFit
std::array<int, 2> numbers_to_try(int wanted, int roomy)
{
    if (roomy > 0 && roomy < wanted)
        return {roomy, roomy / 2};
    if (const int usual = recommended_numbers().front(); wanted < usual)
        return {usual, wanted / 2}; // few are wide, and their values hard to move
    return {3 * wanted / 4, 3 * wanted / 8};
}

/// What is known before a vertex moves.
EmbedReport report_of(const EmbedOptions& options, const Body& body)
{
    EmbedReport result;
    result.method = options.carriers.method;
    result.statistic = options.carriers.statistic;
    result.message = show_message(options.message.bits, options.message.kind);
    result.bits = encode(options.message, options.carriers.bits);
    result.strength = options.placement.strength;
    result.carriers = options.carriers.bits;
    result.pieces = body.pieces;
    result.loose_pieces = body.loose_pieces;
    result.recipe = recipe_of(options);
    return result;
}

/// All points of the mesh with the body's sites placed, those rounded as they will be stored.
Points as_stored(const Body& body, const Points& before, const Points& placed, Storage storage)
{
    Points points = with_sites_at(body, before, placed);
    if (storage == Storage::Float) {
        const Points rounded = rounded_to_float(points);
        for_each_index(static_cast<int>(points.size()), [&](int v) {
            if (body.site_of_vertex[v] >= 0)
                points[v] = rounded[v];
        });
    }
    return points;
}

/// self_check() of the mesh at these points.
/// \param body as it is again afterwards; mended anew only where positions may have a part in that
double read_back(Body& body, const Points& marked, const std::vector<Triangle>& triangles, const Key& key,
                 const EmbedOptions& options, EmbedReport& result, const Progress& progress)
{
    if (std::optional<Points> there = sites_moved(body, marked)) {
        const Exchange exchange(body.surface.points, *there);
        check_surface(body.surface);
        return self_check(body, key, options, result, progress);
    }
    return self_check(body_for(row_of(options.carriers.method), {marked, triangles}), key, options, result, progress);
}

/// \param marked the sites as they are stored
void measure_sites(const Surface& sites, const Points& marked, const VertexFaces& around, EmbedReport& result)
{
    result.mrms = local_mrms(sites.points, marked, sites.triangles, around);
    result.diagonal = bounding_box(sites.points).diagonal().norm();
    result.mrms_relative = result.mrms / result.diagonal;
    if (row_of(result.method).is_smooth)
        result.plane_bend = largest_bend(face_normals(sites.points, sites.triangles), marked, sites.triangles, around);
}

} // namespace

EmbedReport embed(Surface& surface, const Key& key, const EmbedOptions& wanted, const Progress& progress)
{
    const EmbedOptions options = completed(wanted, surface.points.size());
    report(progress, 0, "Finding carriers");
    Stopwatch watch;
    Body body = body_for(row_of(options.carriers.method), {copy_of(surface.points), surface.triangles});
    EmbedReport result = report_of(options, body);
    const auto around = std::make_shared<VertexFaces>(
        vertex_faces(static_cast<int>(body.surface.points.size()), body.surface.triangles));
    Points marked;
    const auto check = [&](const Points& placed) {
        result.seconds["placement"] += watch.lap();
        marked = as_stored(body, surface.points, placed, options.placement.storage);
        const std::size_t warnings = result.warnings.size();
        result.detection_ratio = read_back(body, marked, surface.triangles, key, options, result, progress);
        if (result.detection_ratio < 1)
            result.warnings.resize(warnings);
        result.seconds["check"] += watch.lap();
        return result.detection_ratio;
    };
    Points sites =
        put_on(body, around, held_sites(body, options.held), key, options, result.bits, result, check, progress);
    if (options.placement.storage == Storage::Float)
        sites = rounded_to_float(sites);

    report(progress, 95, "Measuring");
    result.moved_vertices = moved_count(surface.points, marked);
    result.max_displacement = max_displacement(surface.points, marked);
    measure_sites(body.surface, sites, *around, result);
    warn(options, result);
    warn_of_shape(body, result);
    result.seconds["measure"] = watch.lap();
    report(progress, 100, "Done");
    surface.points = std::move(marked);
    return result;
}

int carriers_that_fit(const Surface& surface, const Key& key, const EmbedOptions& wanted, const DoesNotFit& cause,
                      const Progress& progress)
{
    const EmbedOptions options = completed(wanted, surface.points.size());
    const int needed = options.message.kind == Kind::Bits ? 1 : static_cast<int>(options.message.bits.size());
    const auto fits = [&](int count) {
        EmbedOptions tried = options;
        tried.carriers.bits = count;
        if (tried.message.kind == Kind::Bits)
            tried.message.bits.resize(std::min<std::size_t>(tried.message.bits.size(), count));
        Surface copy = surface;
        try {
            embed(copy, key, tried,
                  [&progress](int, const char*) { return !progress || progress(50, "Finding how many bits fit"); });
            return true;
        } catch (const Cancelled&) {
            throw;
        } catch (const Error&) { // of this number, which nobody asked for
            return false;
        }
    };
    for (const int count : numbers_to_try(options.carriers.bits, cause.roomy()))
        if (count >= needed && fits(count))
            return count;
    return 0;
}

} // namespace vcg_ext
