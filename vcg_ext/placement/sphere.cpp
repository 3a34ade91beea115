// SPDX-License-Identifier: GPL-3.0-or-later
#include "sphere.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <ceres/tiny_solver.h>
#include <cmath>

namespace vcg_ext {

namespace {

struct Angle {
    explicit Angle(double radians)
    {
        const double half = radians / 2;
        const double squared = half * half;
        const bool small = squared < 1e-4; // nearly always; then these series are exact to the last bit or two
        const double half_sin = small ? half * (1 - squared / 6 * (1 - squared / 20)) : std::sin(half);
        const double half_cos = small ? 1 - squared / 2 * (1 - squared / 12 * (1 - squared / 30)) : std::cos(half);
        squared_half_sin = half_sin * half_sin;
        sin = 2 * half_sin * half_cos;
        cos = 1 - 2 * squared_half_sin;
    }
    double squared_half_sin, sin, cos;
};

/// The three residuals R (v^ - v) with A = R^T R, over two angles.
///
/// The frame has the ray to `v` on the equator, far from the poles. Angles and residuals are scaled so that the step is
/// of order 1 and the energy at Cho's point is 1, whatever the model's size.
class SphereResidual {
public:
    using Scalar = double;
    enum { NUM_RESIDUALS = 3, NUM_PARAMETERS = 2 };

    SphereResidual(const Point& v, const Point& centre, double norm, const Eigen::Matrix3d& energy)
        : centre_(centre), norm_(norm)
    {
        const double old_norm = (v - centre).norm();
        step_ = std::abs(norm - old_norm);
        sign_ = norm < old_norm ? -1 : 1;
        axes_.col(0) = (v - centre) / old_norm;
        axes_.col(1) = axes_.col(0).unitOrthogonal();
        axes_.col(2) = axes_.col(0).cross(axes_.col(1));
        // The whisper of the identity keeps the factor real where flat neighbours and k3 = 0 leave A singular.
        const double trace = energy.trace();
        const Eigen::Matrix3d regular = energy + Eigen::Matrix3d::Identity() * (1e-12 * trace);
        const double at_cho = axes_.col(0).dot(regular * axes_.col(0));
        const Eigen::Matrix3d upper = Eigen::LLT<Eigen::Matrix3d>(regular / at_cho).matrixU();
        factor_.noalias() = upper.lazyProduct(axes_);
    }

    bool operator()(const double* angles, double* residuals, double* jacobian) const
    {
        const double unit = step_ / norm_;
        const Angle phi(unit * angles[0]);
        const Angle theta(unit * angles[1]);
        // (v^ - v) / step in the frame. cos cos - 1 written so that small angles do not cancel.
        const Point move(sign_ - 2 * (theta.squared_half_sin + theta.cos * phi.squared_half_sin) / unit,
                         theta.cos * phi.sin / unit, theta.sin / unit);
        Eigen::Map<Point>(residuals, 3) = factor_ * move;
        if (jacobian) {
            Eigen::Map<Eigen::Matrix<double, 3, 2>> j(jacobian);
            j.col(0) = factor_ * Point(-theta.cos * phi.sin, theta.cos * phi.cos, 0);
            j.col(1) = factor_ * Point(-theta.sin * phi.cos, -theta.sin * phi.sin, theta.cos);
        }
        return true;
    }

    /// The step from Cho's point to where the residuals would be the least if they were linear, which they nearly are;
    /// none where it leads so far that they are not.
    [[nodiscard]] Eigen::Vector2d linear_minimum() const
    {
        const auto jacobian = factor_.rightCols<2>();
        const Eigen::Matrix2d square = jacobian.transpose().lazyProduct(jacobian);
        const Eigen::Vector2d fall = -sign_ * jacobian.transpose().lazyProduct(factor_.col(0));
        const double determinant = square(0, 0) * square(1, 1) - square(0, 1) * square(0, 1);
        const Eigen::Vector2d angles(square(1, 1) * fall[0] - square(0, 1) * fall[1],
                                     square(0, 0) * fall[1] - square(0, 1) * fall[0]);
        constexpr double far = 0.1; // radians
        if (!(step_ * angles.norm() < far * norm_ * determinant))
            return Eigen::Vector2d::Zero();
        return angles / determinant;
    }

    [[nodiscard]] Point point(const Eigen::Vector2d& angles) const
    {
        const Angle phi(step_ / norm_ * angles[0]);
        const Angle theta(step_ / norm_ * angles[1]);
        return centre_ + norm_ * (axes_ * Point(theta.cos * phi.cos, theta.cos * phi.sin, theta.sin));
    }

private:
    Point centre_;
    double norm_;
    double step_;
    double sign_;
    Eigen::Matrix3d axes_;
    Eigen::Matrix3d factor_;
};

} // namespace

Eigen::Matrix3d sphere_energy(const Cover& cover, const Points& current, int v, const SphereWeights& weights)
{
    const auto [k1, k2, k3] = weights;
    Eigen::Matrix3d sum = k3 * Eigen::Matrix3d::Identity();
    for (const int* f = cover.around.begin(v); f != cover.around.end(v); ++f) {
        const Point& n = cover.normals[*f];
        sum += k1 * n * n.transpose();
        const Point now = scaled_normal_with(current, cover.triangles[*f], v, cover.points[v]);
        const double squared = now.squaredNorm();
        if (squared > 0)
            sum += (k2 / squared) * now * now.transpose();
    }
    return sum;
}

Eigen::Matrix3d sphere_energy(const Cover& cover, int v, const SphereWeights& weights)
{
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0; // of the sum of n n^T
    for (const int* f = cover.around.begin(v); f != cover.around.end(v); ++f) {
        const Point& n = cover.normals[*f];
        xx += n[0] * n[0];
        xy += n[0] * n[1];
        xz += n[0] * n[2];
        yy += n[1] * n[1];
        yz += n[1] * n[2];
        zz += n[2] * n[2];
    }
    Eigen::Matrix3d sum;
    sum << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    return (weights[0] + weights[1]) * sum + weights[2] * Eigen::Matrix3d::Identity();
}

SphereSolution place_on_sphere(const Point& v, const Point& centre, double norm, const Eigen::Matrix3d& energy)
{
    if ((v - centre).norm() == norm)
        return {v, 0, true};
    const SphereResidual residual(v, centre, norm, energy);
    ceres::TinySolver<SphereResidual> solver;
    solver.options.initial_trust_region_radius = 1e8; // moves are small against the norm: nearly linear
    solver.options.max_num_iterations = 500;
    solver.options.parameter_tolerance = 1e-8;
    solver.options.gradient_tolerance = 1e-6;
    solver.options.function_tolerance = 1e-9;
    Eigen::Vector2d angles = residual.linear_minimum();
    const auto& summary = solver.Solve(residual, &angles);
    return {residual.point(angles), summary.iterations,
            summary.status != ceres::TinySolver<SphereResidual>::HIT_MAX_ITERATIONS};
}

} // namespace vcg_ext
