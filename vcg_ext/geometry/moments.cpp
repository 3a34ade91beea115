// SPDX-License-Identifier: GPL-3.0-or-later
#include "moments.h"

#include "../base/parallel.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

namespace vcg_ext {

namespace {

// The integral of a product of k linear functions over a simplex of d dimensions is its measure times
// k! d! / (k + d)! times the polarised complete homogeneous polynomial h_k of the functions' values at the corners. A
// solid is cut into tetrahedra over the origin (d = 3, the values there are zero), a surface is its triangles (d = 2).

enum class Of { Solid, Area };

/// Moments about a point up to the third degree, not divided by the measure.
struct Moments {
    double measure = 0;
    Point first = Point::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    std::array<Eigen::Matrix3d, 3> third{Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()};

    Moments& operator+=(const Moments& other)
    {
        measure += other.measure;
        first += other.first;
        second += other.second;
        for (int i = 0; i < 3; ++i)
            third[i] += other.third[i];
        return *this;
    }
};

double signed_tetrahedron(const Eigen::Matrix3d& p)
{
    return p.col(0).dot(p.col(1).cross(p.col(2))) / 6;
}

double triangle_area(const Eigen::Matrix3d& p)
{
    return (p.col(1) - p.col(0)).cross(p.col(2) - p.col(0)).norm() / 2;
}

/// Takes up the triangle, or the tetrahedron over the origin; corners are columns.
template <Of of>
void take(Moments& m, const Eigen::Matrix3d& p)
{
    constexpr bool solid = of == Of::Solid;
    const double v = solid ? signed_tetrahedron(p) : triangle_area(p);
    const Point sum = p.rowwise().sum();
    const Eigen::Matrix3d pp = p * p.transpose();
    m.measure += v;
    m.first += v / (solid ? 4 : 3) * sum;
    m.second += v / (solid ? 20 : 12) * (pp + sum * sum.transpose());
    // h_3 = (s^3 + 3 s p2 + 2 p3) / 6 by Newton's identity.
    for (int i = 0; i < 3; ++i) {
        Eigen::Matrix3d cubes = Eigen::Matrix3d::Zero();
        for (int corner = 0; corner < 3; ++corner)
            cubes += p(i, corner) * (p.col(corner) * p.col(corner).transpose());
        m.third[i] += v / (solid ? 120 : 60) *
                      (sum[i] * (sum * sum.transpose()) + sum[i] * pp + sum * pp.row(i) + pp.col(i) * sum.transpose() +
                       2 * cubes);
    }
}

Eigen::Matrix3d corners(const Points& points, const Triangle& t, const Point& origin)
{
    Eigen::Matrix3d p;
    for (int k = 0; k < 3; ++k)
        p.col(k) = points[t[k]] - origin;
    return p;
}

/// The third central moment along the unit vector `u`.
double third_moment(const Moments& m, const Point& u)
{
    double raw = 0;
    for (int i = 0; i < 3; ++i)
        raw += u[i] * u.dot(m.third[i] * u) / m.measure;
    const double mean = u.dot(m.first) / m.measure;
    return raw - 3 * mean * u.dot(m.second * u) / m.measure + 2 * mean * mean * mean;
}

/// \return a frame with `measure` 0 where the moments define none
template <Of of>
Frame frame_of(const Points& points, const std::vector<Triangle>& triangles)
{
    const Eigen::AlignedBox3d box = bounding_box(points, triangles);
    if (box.isEmpty())
        return {};
    const Point near = box.center(); // moments about a point far away cancel badly
    const Moments m = ordered_fold(
        static_cast<int>(triangles.size()), Moments{},
        [&](Moments& sum, int f) { take<of>(sum, corners(points, triangles[f], near)); },
        [](Moments& sum, const Moments& part) { sum += part; });
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
    return frame_of<Of::Solid>(points, triangles);
}

Frame area_frame(const Points& points, const std::vector<Triangle>& triangles)
{
    return frame_of<Of::Area>(points, triangles);
}

bool is_symmetric(const Frame& frame, int axis)
{
    // Noise, quantization, smoothing and simplification move bunny00's small one, 0.010, by at most 0.0016.
    constexpr double clear = 0.005;
    return std::abs(frame.third_moments[axis]) < clear * std::pow(frame.variances[axis], 1.5);
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
