// SPDX-License-Identifier: GPL-3.0-or-later
#include "wave_embedding.h"

#include "../base/parallel.h"
#include "../base/pi.h"
#include "../base/progress.h"
#include "../geometry/solid_transform.h"
#include "../geometry/turns.h"
#include "../placement/fold_guard.h"
#include "../placement/wave_field.h"
#include "closed_loop.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace vcg_ext {

namespace {

constexpr int most_rounds = 12;
constexpr double near_enough = 0.025; ///< of a step, a twentieth of what the part leaves undone
/// Of the way to its target that a wave goes at least. Where it goes less than all of it, steps are longer for the same
/// displacement: strong attacks do less harm for what that costs where there is none (distortion-compensated QIM, Chen
/// and Wornell 2001).
constexpr double least_part = 0.7;
constexpr double enough_part = 0.84; ///< of the way: where it would be less, steps are shorter by a rung,
constexpr int rungs_down = 2;        ///< or so many
constexpr double readable = 0.05;    ///< of a step: above it the mark is not worth having

/// The m_k of the body's points as they are in some frame.
std::vector<double> values_in_frame(const WaveBody& body, const Points& points, const Frame& frame,
                                    const WavePlan& plan)
{
    std::vector<std::complex<double>> transform =
        solid_transform(points, body.topology.triangles, plan.vectors, longest_wave);
    if (frame.measure < 0)
        for (std::complex<double>& value : transform)
            value = -value;
    return wave_values_of(transform, plan.phases, false);
}

/// The m_k of vertices as they are now, in the solid's own frame.
std::vector<double> values_now(const WaveBody& body, const Points& vertices, const WavePlan& plan)
{
    Points points = solid_points(body.topology, vertices);
    const Frame frame = frame_again(body, points, body.frame.axes);
    if (frame.measure == 0)
        throw Error("The marked mesh would enclose nothing.");
    points = canonical(frame, points);
    return values_in_frame(body, points, frame, plan);
}

/// From each value to the nearest point of its lattice.
std::vector<double> to_lattice(const WavePlan& plan, const Bits& coded, const std::vector<double>& values, double step)
{
    std::vector<double> change(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double beyond = values[k] / step - plan.dithers[k] - coded[k] * 0.5;
        change[k] = step * (std::round(beyond) - beyond);
    }
    return change;
}

std::string text(const char* format, double a, double b = 0, double c = 0)
{
    char buffer[400];
    std::snprintf(buffer, sizeof buffer, format, a, b, c);
    return buffer;
}

/// The lattice points that waves are to come near to.
struct WaveAim {
    int rung = 0;
    double step = 0;
    double part = 0;             ///< of the way there that every wave goes
    std::vector<double> targets; ///< to where that is
};

WaveAim aim_of(const WaveBody& body, const WaveField& field, const WavePlan& plan, const Bits& coded,
               const std::vector<double>& now, double strength)
{
    WaveAim aim;
    (void)wave_step(body, strength, plan.count(), &aim.rung);
    std::vector<double> change;
    const int lowest = aim.rung - rungs_down;
    for (;; --aim.rung) {
        aim.step = step_of_rung(aim.rung);
        change = to_lattice(plan, coded, now, aim.step);
        aim.part = strength * body.diagonal / body.radius / field.size(change);
        if (aim.part > enough_part || aim.rung == lowest)
            break;
    }
    aim.part = std::clamp(aim.part, least_part, 1.0);
    for (std::size_t k = 0; k < now.size(); ++k)
        aim.targets.push_back(now[k] + aim.part * change[k]);
    return aim;
}

/// How far waves are from their targets.
struct Misses {
    std::vector<double> by;
    int worst_wave = 0;
    double worst = 0; ///< in steps
};

Misses misses_of(const WaveAim& aim, const std::vector<double>& now)
{
    Misses misses;
    for (std::size_t k = 0; k < now.size(); ++k) {
        misses.by.push_back(aim.targets[k] - now[k]);
        if (const double steps = std::abs(misses.by[k]) / aim.step; steps > misses.worst) {
            misses.worst = steps;
            misses.worst_wave = static_cast<int>(k);
        }
    }
    return misses;
}

/// A wave's length over the diagonal.
double length_of(const WavePlan& plan, int wave, const WaveBody& body)
{
    return 2 * pi / plan.vectors[wave].norm() * body.radius / body.diagonal;
}

/// RMS over the surface of what moves it along `offset`, over the diagonal.
double rms_of(const WaveBody& body, const std::vector<double>& offset)
{
    const double squares = ordered_sum(body.topology.surface_triangles, 0.0, [&](int f) {
        const Triangle& t = body.topology.triangles[f];
        const double s[3] = {offset[t[0]], offset[t[1]], offset[t[2]]};
        const double sum = s[0] + s[1] + s[2];
        return scaled_normal(body.points, t).norm() * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + sum * sum) / 24;
    });
    return std::sqrt(squares / body.area) * body.radius / body.diagonal;
}

void check_axes(const Point& variances)
{
    if (variances[0] - variances[2] < 0.02 * variances[0])
        throw Error(
            "The body is as wide in every direction, as spheres and cubes are, so it has no axes of its own that "
            "Waves could find again. Choose another method.");
}

/// \throw Error where some wave did not come near enough to be read
void check_readable(const Misses& misses, const WavePlan& plan, const WaveBody& body)
{
    if (misses.worst <= readable)
        return;
    const Point& variances = body.frame.variances;
    const double gap =
        std::min((variances[0] - variances[1]) / variances[0], (variances[1] - variances[2]) / variances[1]);
    if (gap < 0.03)
        throw Error(
            text("The body is round about one of its axes: two of its three variances differ by %.2f %% only, so "
                 "the angle about that axis is not defined, and Waves cannot find it again. Choose another "
                 "method.",
                 100 * gap));
    throw Error(text("The mesh cannot be displaced as smoothly as Waves asks: wave %.0f, of length %.3f of the "
                     "diagonal, ends %.2f of a step from where its bit is. Take a finer mesh or another method.",
                     misses.worst_wave, length_of(plan, misses.worst_wave, body), misses.worst));
}

/// \throw Error where the surface moves by far more than it was to
void check_moved(double moved, double strength, const WaveField& field, const WavePlan& plan, const WaveBody& body)
{
    if (moved <= 2.5 * strength)
        return;
    int least = 0;
    for (int k = 1; k < plan.count(); ++k)
        if (field.reach(k) < field.reach(least))
            least = k;
    throw Error(text("The mesh is too coarse for Waves: wave %.0f, of length %.3f of the diagonal, takes faces that "
                     "are smaller. The mark would move the surface by %.1e of the diagonal. Take a finer mesh or "
                     "another method.",
                     least, length_of(plan, least, body), moved));
}

} // namespace

WaveEmbedding embed_waves(const Cover& cover, const WavePlan& plan, const Bits& coded, double strength,
                          const std::function<Points(const Points&)>& round, const Progress& progress)
{
    const WaveBody body = wave_body(cover.surface);
    check_axes(body.frame.variances);
    if (body.topology.sites < plan.count())
        throw Error("The mesh has fewer vertices than there are waves.");
    const WaveField field(body, plan, cover.around);
    const Points directions = offset_directions(body, cover.around);

    const std::vector<double> before = values_in_frame(body, body.points, body.frame, plan);
    const WaveAim aim = aim_of(body, field, plan, coded, before, strength);
    WaveEmbedding result;
    result.points = cover.points;
    result.step = aim.step;
    result.rung = aim.rung;
    result.part = aim.part;
    Misses misses = misses_of(aim, before);
    result.worst = misses.worst;
    if (misses.worst < near_enough) // the mark is there already
        return result;

    std::vector<double> offset(body.topology.sites, 0); // canonical
    Misses kept;
    std::vector<double> kept_offset;
    Points placed;
    int guarded = 0;
    const auto place_and_read = [&](int) {
        const std::vector<double> more = field.least(misses.by);
        for_each_index(body.topology.sites, [&](int v) { offset[v] += more[v]; });
        const auto at = [&](int v, double part) -> Point {
            return cover.points[v] + part * body.radius * offset[v] * (body.frame.axes * directions[v]);
        };
        placed.resize(cover.points.size());
        for_each_index(static_cast<int>(placed.size()), [&](int v) { placed[v] = at(v, 1); });
        constexpr int steps = 4;
        const Moves back = guard_folds(cover, placed, steps, [&](int v, int step) { return at(v, 1.0 - step / 4.0); });
        guarded = static_cast<int>(back.vertices.size());
        placed = round(placed);
        misses = misses_of(aim, values_now(body, placed, plan));
        return near_enough - misses.worst;
    };
    result.rounds = closed_loop(most_rounds, "Displacing the surface", progress, place_and_read, [&] {
        result.points = std::move(placed);
        result.guarded = guarded;
        kept_offset = offset;
        kept = misses;
    });
    result.worst = kept.worst;
    check_readable(kept, plan, body);
    result.moved = rms_of(body, kept_offset);
    check_moved(result.moved, strength, field, plan, body);
    return result;
}

} // namespace vcg_ext
