// SPDX-License-Identifier: GPL-3.0-or-later
#include "wave_body.h"

#include "../base/error.h"
#include "../base/parallel.h"
#include "../base/pi.h"

#include <algorithm>
#include <cmath>

namespace vcg_ext {

namespace {

constexpr double round_below = 0.05;  ///< relative difference of two variances below which the angle is not theirs
constexpr double never_round = 0.1;   ///< and the same from which on no copy's can be there
constexpr double always_round = 0.02; ///< and below
constexpr int most_fold = 12;
constexpr double clear = 0.01; ///< of a moment, over that of a disc all on one side

/// An angle about the odd axis by which a body can be held, and how often it comes again in a turn.
struct Angle {
    int fold = 0;
    double angle = 0; ///< from the frame's own
    double size = 0;
};

Eigen::Matrix3d turn_about(int axis, double angle)
{
    return Eigen::AngleAxisd(angle, Point::Unit(axis)).toRotationMatrix();
}

Angle angle_of(const Points& points, const std::vector<Triangle>& triangles, const Frame& frame, int odd_axis, int fold)
{
    const int first = (odd_axis + 1) % 3;
    const int second = (odd_axis + 2) % 3;
    const auto [re, im] = angular_moment(points, triangles, frame, first, second, fold);
    const double r = ball_radius(frame);
    const double spread = (frame.variances[first] + frame.variances[second]) / (r * r);
    const double of_a_disc = std::pow(2 * spread, fold / 2.0) * 2 / (fold + 2);
    return {fold, std::atan2(im, re) / fold, std::hypot(re, im) / of_a_disc};
}

/// The angles that are clear, the best first: the lowest fold that has half of the largest moment.
std::vector<Angle> angles_of(const Points& points, const std::vector<Triangle>& triangles, const Frame& frame,
                             int odd_axis)
{
    std::vector<Angle> all;
    double largest = clear;
    for (int fold = 3; fold <= most_fold; ++fold) {
        all.push_back(angle_of(points, triangles, frame, odd_axis, fold));
        largest = std::max(largest, all.back().size);
    }
    const auto out = [&](double share) { return [=](const Angle& angle) { return angle.size < share * largest; }; };
    all.erase(std::remove_if(all.begin(), all.end(), out(0.25)), all.end());
    std::rotate(all.begin(), std::find_if_not(all.begin(), all.end(), out(0.5)), all.end());
    if (all.size() > 2)
        all.resize(2); // what another copy may have taken
    return all;
}

/// What a frame that is held by `angle` cannot tell apart. Odd folds by twice as many: mirror images come as
/// inversions, and those turn the moment round.
void add_turns(const Angle& angle, int odd_axis, std::vector<Eigen::Matrix3d>& turns)
{
    const int steps = angle.fold % 2 == 0 ? angle.fold : 2 * angle.fold;
    const Eigen::Matrix3d over = turn_about((odd_axis + 1) % 3, pi);
    for (const bool flip : {false, true})
        for (int j = 0; j < steps; ++j) {
            const Eigen::Matrix3d turn = turn_about(odd_axis, 2 * pi * j / steps - angle.angle);
            turns.push_back(flip ? Eigen::Matrix3d(over * turn) : turn);
        }
}

void add_half_turns(double angle, int odd_axis, std::vector<Eigen::Matrix3d>& turns)
{
    const Eigen::Matrix3d turn = turn_about(odd_axis, -angle);
    turns.push_back(turn);
    for (int axis = 0; axis < 3; ++axis)
        turns.emplace_back(turn_about(axis, pi) * turn);
}

} // namespace

WaveBody wave_body(const Surface& surface)
{
    WaveBody body;
    body.topology = solid_topology(surface);
    body.diagonal = bounding_diagonal(surface);
    body.points = solid_points(body.topology, surface.points);
    body.frame = solid_frame(body.points, body.topology.triangles);
    if (body.frame.measure == 0 || !body.topology.orientable)
        throw Error(
            "The mesh encloses nothing: its faces bound no solid. Waves marks bodies; close the mesh, or choose "
            "another method.");
    body.radius = ball_radius(body.frame);

    const Point& variances = body.frame.variances;
    const double gaps[2] = {1 - variances[1] / variances[0], 1 - variances[2] / variances[1]};
    const double gap = std::min(gaps[0], gaps[1]);
    body.odd_axis = gaps[0] < gaps[1] ? 2 : 0;
    const std::vector<Angle> angles = gap < never_round
                                          ? angles_of(body.points, body.topology.triangles, body.frame, body.odd_axis)
                                          : std::vector<Angle>();
    double held = 0;
    if (gap < round_below && !angles.empty()) {
        body.fold = angles.front().fold;
        held = angles.front().angle;
        body.frame.axes *= turn_about(body.odd_axis, held);
    }
    const auto half_turns = [&] { add_half_turns(-held, body.odd_axis, body.turns); };
    if (body.fold == 0)
        half_turns();
    for (Angle angle : angles) {
        angle.angle -= held;
        add_turns(angle, body.odd_axis, body.turns);
    }
    if (body.fold != 0 && gap > always_round)
        half_turns();

    body.points = canonical(body.frame, body.points);
    body.area = area_of(body, body.points);
    return body;
}

Frame frame_again(const WaveBody& body, const Points& points, const Eigen::Matrix3d& like)
{
    Frame frame = solid_frame(points, body.topology.triangles);
    if (frame.measure == 0)
        return frame;
    align_axes(frame, like);
    if (body.fold == 0)
        return frame;
    const int first = (body.odd_axis + 1) % 3;
    const int second = (body.odd_axis + 2) % 3;
    const Point odd = frame.axes.col(body.odd_axis);
    frame.axes.col(first) = (like.col(first) - odd.dot(like.col(first)) * odd).normalized();
    frame.axes.col(second) = odd.cross(frame.axes.col(first));
    frame.axes *=
        turn_about(body.odd_axis, angle_of(points, body.topology.triangles, frame, body.odd_axis, body.fold).angle);
    return frame;
}

Points canonical(const Frame& frame, const Points& points)
{
    const double r = ball_radius(frame);
    Points result(points.size());
    for_each_index(static_cast<int>(points.size()),
                   [&](int v) { result[v] = frame.axes.transpose() * (points[v] - frame.centre) / r; });
    return result;
}

double area_of(const WaveBody& body, const Points& points)
{
    return ordered_sum(body.topology.surface_triangles, 0.0,
                       [&](int f) { return scaled_normal(points, body.topology.triangles[f]).norm() / 2; });
}

} // namespace vcg_ext
