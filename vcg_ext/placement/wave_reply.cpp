// SPDX-License-Identifier: GPL-3.0-or-later
#include "wave_reply.h"

#include "../base/parallel.h"
#include "../base/pi.h"
#include "../geometry/solid_transform.h"
#include "../geometry/turns.h"

#include <array>
#include <cmath>
#include <complex>

namespace vcg_ext {

namespace {

/// How the frame moves, per amplitude: centre, the turn of the axes (a rotation vector), logarithm of the radius.
using Motion = Eigen::Matrix<double, 7, 1>;

/// The transform of the body at the plan's waves, and its gradients by q, an entry a wave.
struct Transform {
    std::vector<std::complex<double>> value;
    std::array<std::vector<std::complex<double>>, 3> gradient;
};

Transform transform_of(const WaveBody& body, const WavePlan& plan)
{
    constexpr double step = 0.01; // |x| is some 2, so the third derivative adds 1e-4 of the first
    const std::size_t count = plan.vectors.size();
    Points waves = plan.vectors;
    for (int k = 0; k < 3; ++k)
        for (const double side : {1.0, -1.0})
            for (const Point& q : plan.vectors)
                waves.emplace_back(q + side * step * Point::Unit(k));
    std::vector<std::complex<double>> all =
        solid_transform(body.points, body.topology.triangles, waves, longest_wave + step);
    const double outward = body.frame.measure < 0 ? -1 : 1;
    for (auto& value : all)
        value *= outward;
    Transform result;
    result.value.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < count; ++i)
            result.gradient[k].push_back((all[(1 + 2 * k) * count + i] - all[(2 + 2 * k) * count + i]) / (2 * step));
    return result;
}

/// Derivative of one m by the frame's motion. Where the frame moves by c, turns by w and grows by s, the points of the
/// solid move by -c - w x p - s p in it, and F(q) changes by -i q.c F + grad F . (w x q - s q) - 3 s F.
Motion by_frame(const Transform& transform, std::size_t wave, const Point& q, double phase)
{
    double s, c;
    sine_cosine(phase, s, c);
    const auto real_part = [&](const std::complex<double>& value) { return c * value.real() - s * value.imag(); };
    const std::complex<double> f = transform.value[wave];
    Point gradient;
    for (int k = 0; k < 3; ++k)
        gradient[k] = real_part(transform.gradient[k][wave]);
    Motion result;
    result << real_part(std::complex<double>(0, -1) * f) * q, q.cross(gradient), -gradient.dot(q) - 3 * real_part(f);
    return result;
}

/// Frames by principal axes: from the integrals of each wave times 1, x, y, z, yz, zx and xy.
Eigen::MatrixXd motion_of_axes(const WaveBody& body, const WaveField& field)
{
    const double volume = 4 * pi / 3; // in radii
    const double r = ball_radius(body.frame);
    const Point spread = body.frame.variances / (r * r);
    Eigen::MatrixXd motion = field.integrals(7, [](const Point& p) {
        Eigen::VectorXd f(7);
        f << p, p[1] * p[2], p[2] * p[0], p[0] * p[1], 1;
        return f;
    });
    motion /= volume;
    motion.row(3) /= spread[1] - spread[2];
    motion.row(4) /= spread[2] - spread[0];
    motion.row(5) /= spread[0] - spread[1];
    motion.row(6) /= 3;
    return motion;
}

/// Frames whose angle about an axis is held otherwise: by moving the surface and looking.
Eigen::MatrixXd motion_as_seen(const WaveBody& body, const WaveField& field, int count)
{
    constexpr double step = 1e-4;
    const int sites = body.topology.sites;
    std::vector<int> all(sites);
    for (int v = 0; v < sites; ++v)
        all[v] = v;
    const std::vector<double> waves = field.at_sites(all);
    const Points directions = offset_directions(body);
    Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(7, count);
    for_chunks(count, 1, [&](int k, int) {
        std::array<Frame, 2> seen;
        for (const int side : {0, 1}) {
            Points points = body.points;
            for (int v = 0; v < sites; ++v)
                points[v] +=
                    (side == 0 ? step : -step) * waves[static_cast<std::size_t>(v) * count + k] * directions[v];
            place_apexes(body.topology, points);
            seen[side] = frame_again(body, points, Eigen::Matrix3d::Identity());
        }
        if (seen[0].measure == 0 || seen[1].measure == 0)
            return;
        const Eigen::AngleAxisd turn(Eigen::Matrix3d(seen[0].axes * seen[1].axes.transpose()));
        motion.col(k) << seen[0].centre - seen[1].centre, turn.angle() * turn.axis(),
            std::log(ball_radius(seen[0]) / ball_radius(seen[1]));
        motion.col(k) /= 2 * step;
    });
    return motion;
}

} // namespace

WaveReply::WaveReply(const WaveBody& body, const WavePlan& plan) : plan_(plan), field_(body, plan_)
{
    const int count = plan.count();
    const Transform transform = transform_of(body, plan);
    values_ = wave_values_of(transform.value, plan.phases, false);
    Eigen::MatrixXd frame(count, 7);
    for (int k = 0; k < count; ++k)
        frame.row(k) = by_frame(transform, k, plan.vectors[k], plan.phases[k]);
    const Eigen::MatrixXd motion = body.fold == 0 ? motion_of_axes(body, field_) : motion_as_seen(body, field_, count);
    derivative_ = field_.gram() / (4 * pi) + frame * motion;
    solver_.compute(derivative_);
}

WaveMoves wave_moves(const WavePlan& plan, const std::vector<double>& values,
                     const Eigen::PartialPivLU<Eigen::MatrixXd>& derivative, int rung)
{
    const double step = step_of_rung(rung);
    const int count = plan.count();
    Eigen::VectorXd middle(count);
    Eigen::VectorXd half(count);
    for (int k = 0; k < count; ++k) {
        double move[2];
        for (const int bit : {0, 1}) {
            const double shift = plan.dithers[k] + bit * 0.5;
            move[bit] = usual_part * (step * (std::round(values[k] / step - shift) + shift) - values[k]);
        }
        middle[k] = (move[0] + move[1]) / 2;
        half[k] = (move[1] - move[0]) / 2;
    }
    WaveMoves moves;
    moves.rung = rung;
    moves.middle = derivative.solve(middle);
    moves.per_bit = derivative.solve(Eigen::MatrixXd(half.asDiagonal()));
    return moves;
}

} // namespace vcg_ext
