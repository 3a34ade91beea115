// SPDX-License-Identifier: GPL-3.0-or-later
#include "wave_embedding.h"

#include "../base/parallel.h"
#include "../base/pi.h"
#include "../base/progress.h"
#include "../geometry/turns.h"
#include "../geometry/wave_sums.h"
#include "../placement/fold_guard.h"
#include "../placement/wave_field.h"

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

} // namespace

WaveEmbedding embed_waves(const Cover& cover, const WavePlan& plan, const Bits& coded, double strength,
                          const std::function<Points(const Points&)>& round, const Progress& progress)
{
    const WaveBody body = wave_body(cover.surface);
    const Point& variances = body.frame.variances;
    if (variances[0] - variances[2] < 0.02 * variances[0])
        throw Error(
            "The body is as wide in every direction, as spheres and cubes are, so it has no axes of its own that "
            "Waves could find again. Choose another method.");
    const int waves = plan.count();
    if (body.topology.sites < waves)
        throw Error("The mesh has fewer vertices than there are waves.");
    WaveEmbedding result;
    (void)wave_step(body, strength, waves, &result.rung);
    const WaveField field(body, plan, cover.around);
    const Points directions = offset_directions(body, cover.around);
    const int vertices = static_cast<int>(cover.points.size());

    std::vector<double> offset(body.topology.sites, 0); // canonical
    std::vector<double> best_offset;
    std::vector<double> target;
    const auto place = [&](const std::vector<double>& s) {
        Points placed(vertices);
        const auto at = [&](int v, double part) -> Point {
            return cover.points[v] + part * body.radius * s[v] * (body.frame.axes * directions[v]);
        };
        for_each_index(vertices, [&](int v) { placed[v] = at(v, 1); });
        constexpr int steps = 4;
        const std::vector<int> held =
            guard_folds(cover, placed, steps, [&](int v, int step) { return at(v, 1.0 - step / 4.0); });
        result.guarded = static_cast<int>(std::count_if(held.begin(), held.end(), [](int step) { return step > 0; }));
        return round(placed);
    };

    result.worst = 1e300;
    int worst_wave = 0;
    for (int turn = 0;; ++turn) {
        report(progress, 100 * turn / (most_rounds + 1), "Waves");
        Points placed = turn == 0 ? cover.points : place(offset);
        const std::vector<double> now =
            turn == 0 ? values_in_frame(body, body.points, body.frame, plan) : values_now(body, placed, plan);
        if (target.empty()) {
            std::vector<double> change;
            const int lowest = result.rung - rungs_down;
            for (;; --result.rung) {
                result.step = step_of_rung(result.rung);
                change = to_lattice(plan, coded, now, result.step);
                result.part = strength * body.diagonal / body.radius / field.size(change);
                if (result.part > enough_part || result.rung == lowest)
                    break;
            }
            result.part = std::clamp(result.part, least_part, 1.0);
            for (int k = 0; k < waves; ++k)
                target.push_back(now[k] + result.part * change[k]);
        }
        std::vector<double> missing(waves);
        double worst = 0;
        int wave = 0;
        for (int k = 0; k < waves; ++k) {
            missing[k] = target[k] - now[k];
            if (const double size = std::abs(missing[k]) / result.step; size > worst) {
                worst = size;
                wave = k;
            }
        }
        if (worst < result.worst || turn <= 1) {
            result.worst = worst;
            worst_wave = wave;
            result.points = std::move(placed);
            best_offset = offset;
        }
        result.rounds = turn;
        if (worst < near_enough || turn == most_rounds)
            break;
        const std::vector<double> more = field.least(missing);
        for_each_index(body.topology.sites, [&](int v) { offset[v] += more[v]; });
    }

    const double gap =
        std::min((variances[0] - variances[1]) / variances[0], (variances[1] - variances[2]) / variances[1]);
    if (result.worst > readable && gap < 0.03)
        throw Error(
            text("The body is round about one of its axes: two of its three variances differ by %.2f %% only, so "
                 "the angle about that axis is not defined, and Waves cannot find it again. Choose another "
                 "method.",
                 100 * gap));
    const double length = 2 * pi / plan.vectors[worst_wave].norm() * body.radius / body.diagonal;
    if (result.worst > readable)
        throw Error(text("The mesh cannot be displaced as smoothly as Waves asks: wave %.0f, of length %.3f of the "
                         "diagonal, ends %.2f of a step from where its bit is. Take a finer mesh or another method.",
                         worst_wave, length, result.worst));
    const double squares = ordered_sum(body.topology.surface_triangles, 0.0, [&](int f) {
        const Triangle& t = body.topology.triangles[f];
        const double s[3] = {best_offset[t[0]], best_offset[t[1]], best_offset[t[2]]};
        const double sum = s[0] + s[1] + s[2];
        return scaled_normal(body.points, t).norm() * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + sum * sum) / 24;
    });
    result.moved = std::sqrt(squares / body.area) * body.radius / body.diagonal;
    if (result.moved > 2.5 * strength) {
        int least = 0;
        for (int k = 1; k < waves; ++k)
            if (field.reach(k) < field.reach(least))
                least = k;
        throw Error(
            text("The mesh is too coarse for Waves: wave %.0f, of length %.3f of the diagonal, takes faces that "
                 "are smaller. The mark would move the surface by %.1e of the diagonal. Take a finer mesh or "
                 "another method.",
                 least, 2 * pi / plan.vectors[least].norm() * body.radius / body.diagonal, result.moved));
    }
    return result;
}

} // namespace vcg_ext
