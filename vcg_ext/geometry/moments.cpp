// SPDX-License-Identifier: GPL-3.0-or-later
#include "moments.h"

#include "../base/parallel.h"
#include "raw_moments.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

namespace vcg_ext {

namespace {

double signed_tetrahedron(const Eigen::Matrix3d& p)
{
    return p.col(0).dot(p.col(1).cross(p.col(2))) / 6;
}

Eigen::Matrix3d corners(const Points& points, const Triangle& t, const Point& origin)
{
    Eigen::Matrix3d p;
    for (int k = 0; k < 3; ++k)
        p.col(k) = points[t[k]] - origin;
    return p;
}

/// The third central moment along the unit vector `u`.
double third_moment(const RawMoments& m, const Point& u)
{
    double raw = 0;
    for (int i = 0; i < 3; ++i)
        raw += u[i] * u.dot(m.third[i] * u) / m.measure;
    const double mean = u.dot(m.first) / m.measure;
    return raw - 3 * mean * u.dot(m.second * u) / m.measure + 2 * mean * mean * mean;
}

/// \return a frame with `measure` 0 where the moments define none
Frame frame_of(Of of, const Points& points, const std::vector<Triangle>& triangles)
{
    const Eigen::AlignedBox3d box = bounding_box(points);
    if (triangles.empty())
        return {};
    const Point near = box.center(); // moments about a point far away cancel badly
    const RawMoments m = raw_moments(of, points, triangles, near);
    const double size = box.diagonal().norm();
    if (!(std::abs(m.measure) > (of == Of::Solid ? 1e-9 * std::pow(size, 3) : 1e-12 * std::pow(size, 2))))
        return {};
    Frame frame;
    frame.from_volume = of == Of::Solid;
    frame.measure = m.measure;
    const Point mean = m.first / m.measure;
    frame.centre = near + mean;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(m.second / m.measure - mean * mean.transpose());
    frame.variances = solver.eigenvalues().reverse();
    // A solid of parts that are turned inside out against each other can have negative variances.
    if (of == Of::Solid && !(frame.variances[2] > 0))
        return {};
    frame.axes = solver.eigenvectors().rowwise().reverse();
    if (frame.axes.determinant() < 0)
        frame.axes.col(2) *= -1;
    for (int axis = 0; axis < 3; ++axis)
        frame.third_moments[axis] = third_moment(m, frame.axes.col(axis));
    for (int axis = 0; axis < 2; ++axis)
        if (frame.third_moments[axis] < 0)
            for (const int turned : {axis, 2}) {
                frame.axes.col(turned) *= -1;
                frame.third_moments[turned] *= -1;
            }
    return frame;
}

} // namespace

Frame solid_frame(const Points& points, const std::vector<Triangle>& triangles)
{
    return frame_of(Of::Solid, points, triangles);
}

Frame area_frame(const Points& points, const std::vector<Triangle>& triangles)
{
    return frame_of(Of::Area, points, triangles);
}

bool is_symmetric(const Frame& frame, int axis)
{
    // Noise, quantization, smoothing and simplification move bunny00's small one, 0.010, by at most 0.0016.
    constexpr double clear = 0.005;
    return std::abs(frame.third_moments[axis]) < clear * std::pow(frame.variances[axis], 1.5);
}

std::string name(AxisFlips flips)
{
    return {flips.first ? '-' : '+', flips.second ? '-' : '+'};
}

Frame flipped(Frame frame, AxisFlips flips)
{
    const Point signs(flips.first ? -1 : 1, flips.second ? -1 : 1, flips.first != flips.second ? -1 : 1);
    frame.axes *= signs.asDiagonal();
    frame.third_moments = frame.third_moments.cwiseProduct(signs);
    return frame;
}

bool may_be_flipped(const Frame& frame, AxisFlips flips)
{
    return (!flips.first || is_symmetric(frame, 0)) && (!flips.second || is_symmetric(frame, 1));
}

Frame turned_like(Frame frame, const Frame& like)
{
    for (int k = 0; k < 3; ++k)
        if (frame.axes.col(k).dot(like.axes.col(k)) < 0)
            frame.axes.col(k) *= -1;
    return frame;
}

bool is_round(const Frame& frame)
{
    constexpr double clear = 0.02;
    const Point& v = frame.variances;
    return v[0] - v[1] < clear * v[0] || v[1] - v[2] < clear * v[1];
}

double signed_volume(const Surface& surface, const Point& centre)
{
    return ordered_sum(static_cast<int>(surface.triangles.size()), 0.0, [&](int f) {
        return signed_tetrahedron(corners(surface.points, surface.triangles[f], centre));
    });
}

} // namespace vcg_ext
