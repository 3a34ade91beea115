// SPDX-License-Identifier: GPL-3.0-or-later
#include "icp.h"

#include "../base/median.h"
#include "../base/parallel.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace vcg_ext {

namespace {

constexpr int least_feet = 30;
constexpr double largest_turn = 0.3;    ///< radians, a step
constexpr double largest_stretch = 0.2; ///< a step

using Unknowns = Eigen::Matrix<double, 12, 1>;

/// A sample that counts: where it is, the plane that it should lie in, and how far it is from that.
struct Pair {
    Point at, normal;
    double missing;
};

/// What each unknown does to a sample's distance from its plane: turns, shifts, scale, and five ways of stretching.
Unknowns effects(const Point& z, const Point& n)
{
    Unknowns j;
    j << z.cross(n), n, z.dot(n), z[0] * n[0] - z[1] * n[1], z[1] * n[1] - z[2] * n[2], z[0] * n[1] + z[1] * n[0],
        z[0] * n[2] + z[2] * n[0], z[1] * n[2] + z[2] * n[1];
    return j;
}

/// The motion that the unknowns stand for, about `centre`.
Eigen::Affine3d motion(const Unknowns& u, const Point& centre, bool affine)
{
    const auto bounded = [](double x) { return std::clamp(x, -largest_stretch, largest_stretch); };
    Point turn = u.head<3>();
    const double angle = turn.norm();
    Eigen::Matrix3d stretch = (1 + bounded(u[6])) * Eigen::Matrix3d::Identity();
    if (affine) {
        Eigen::Matrix3d shear;
        shear << u[7], u[9], u[10], u[9], u[8] - u[7], u[11], u[10], u[11], -u[8];
        stretch += shear.unaryExpr(bounded);
    }
    Eigen::Matrix3d linear = stretch;
    if (angle > 0)
        linear = Eigen::AngleAxisd(std::min(angle, largest_turn), turn / angle).toRotationMatrix() * stretch;
    Eigen::Affine3d result;
    result.linear() = linear;
    result.translation() = centre + u.segment<3>(3) - linear * centre;
    return result;
}

Point turned_normal(const Eigen::Matrix3d& inverse_transposed, const Point& normal)
{
    return (inverse_transposed * normal).normalized();
}

double median_of_sizes(const std::vector<Pair>& pairs)
{
    std::vector<double> sizes;
    sizes.reserve(pairs.size());
    for (const Pair& pair : pairs)
        sizes.push_back(std::abs(pair.missing));
    return median(std::move(sizes));
}

/// One step's unknowns. \param floor of the spread, in the original's unit
Unknowns step(const std::vector<Pair>& pairs, const Point& centre, bool affine, double floor)
{
    const double spread = 1.4826 * median_of_sizes(pairs) + floor;
    const int unknowns = affine ? 12 : 7;
    Eigen::Matrix<double, 12, 12> normal = Eigen::Matrix<double, 12, 12>::Zero();
    Unknowns right = Unknowns::Zero();
    for (const Pair& pair : pairs) {
        const double r = pair.missing / (2 * spread);
        const double weight = 1 / ((1 + r * r) * (1 + r * r));
        const Unknowns j = effects(pair.at - centre, pair.normal);
        normal.noalias() += weight * j * j.transpose();
        right += weight * pair.missing * j;
    }
    const auto block = normal.topLeftCorner(unknowns, unknowns);
    const Eigen::MatrixXd ridged =
        block +
        1e-10 * block.trace() * Eigen::MatrixXd::Identity(unknowns, unknowns); // a sphere does not fix its turns
    Unknowns u = Unknowns::Zero();
    u.head(unknowns) = ridged.ldlt().solve(right.head(unknowns));
    return u;
}

} // namespace

std::vector<Foot> feet_of(const FootSearch& original, const Points& points, int count, const Eigen::Affine3d& pose,
                          double reach)
{
    std::vector<Foot> feet(count);
    for_chunks(count, 128, [&](int begin, int end) {
        for (int i = begin; i < end; ++i)
            feet[i] = original(pose * points[i], reach);
    });
    return feet;
}

double side_of(const FootSearch& original, const SurfaceSamples& samples, const std::vector<Foot>& feet,
               const Eigen::Affine3d& pose)
{
    const Eigen::Matrix3d turn = pose.linear().inverse().transpose();
    double sum = 0;
    for (std::size_t i = 0; i < feet.size(); ++i)
        if (feet[i].face >= 0)
            sum += turned_normal(turn, samples.normals[i]).dot(original.normals()[feet[i].face]);
    return sum < 0 ? -1 : 1;
}

bool refine_pose(const FootSearch& original, const SurfaceSamples& samples, int count, const IcpOptions& options,
                 Eigen::Affine3d& pose)
{
    Eigen::Affine3d now = pose;
    double reach = options.first_reach;
    for (int iteration = 0; iteration < options.iterations; ++iteration) {
        const std::vector<Foot> feet = feet_of(original, samples.points, count, now, reach);
        const double side = side_of(original, samples, feet, now);
        const Eigen::Matrix3d turn = now.linear().inverse().transpose();
        std::vector<Pair> pairs;
        Point centre = Point::Zero();
        for (int i = 0; i < count; ++i) {
            if (feet[i].face < 0 || feet[i].on_rim)
                continue;
            const Point& n = original.normals()[feet[i].face];
            if (!(side * turned_normal(turn, samples.normals[i]).dot(n) > options.least_cosine))
                continue;
            const Point at = now * samples.points[i];
            pairs.push_back({at, n, n.dot(feet[i].point - at)});
            centre += at;
        }
        if (static_cast<int>(pairs.size()) < least_feet)
            return false;
        centre /= static_cast<double>(pairs.size());
        const Unknowns u = step(pairs, centre, options.affine, 1e-9 * options.last_reach);
        now = motion(u, centre, options.affine) * now;
        if (!now.matrix().allFinite() || !(std::abs(now.linear().determinant()) > 0))
            return false;
        const double moved =
            std::max({u.head<3>().norm(), u.segment<3>(3).norm() / options.last_reach * .02, u.tail<6>().norm()});
        if (reach <= options.last_reach && moved < 1e-6)
            break;
        reach = std::max(reach * .7, options.last_reach);
    }
    pose = now;
    return true;
}

} // namespace vcg_ext
