// SPDX-License-Identifier: GPL-3.0-or-later
#include "features.h"

#include "../base/parallel.h"
#include "../base/pi.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <utility>

namespace vcg_ext {

namespace {

constexpr std::array<double, 4> radii = {0.03, 0.05, 0.08, 0.12};
constexpr double normal_radius = 0.02;

/// Sums over the samples inside a ball, relative to its centre.
struct Ball {
    int count = 0;
    Point first = Point::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    Point normal = Point::Zero();
};

/// The samples about a point by their distance: balls of any radius by one look each.
class Surroundings {
public:
    Surroundings(const SurfaceSamples& samples, const Point& centre, double reach)
    {
        std::vector<std::pair<double, int>> near;
        for (std::size_t i = 0; i < samples.points.size(); ++i)
            if (const double d = (samples.points[i] - centre).squaredNorm(); d <= reach * reach)
                near.emplace_back(d, static_cast<int>(i));
        std::sort(near.begin(), near.end());
        Ball sum;
        for (const auto& [distance, i] : near) {
            const Point x = samples.points[i] - centre;
            ++sum.count;
            sum.first += x;
            sum.second += x * x.transpose();
            sum.normal += samples.normals[i];
            squared_.push_back(distance);
            balls_.push_back(sum);
        }
    }

    [[nodiscard]] Ball ball(double radius) const
    {
        const auto end = std::upper_bound(squared_.begin(), squared_.end(), radius * radius);
        return end == squared_.begin() ? Ball() : balls_[end - squared_.begin() - 1];
    }

private:
    std::vector<double> squared_;
    std::vector<Ball> balls_;
};

Descriptor describe(const Surroundings& around, double size, const Point& normal, double share)
{
    Descriptor result = Descriptor::Zero();
    for (std::size_t i = 0; i < radii.size(); ++i) {
        const double r = radii[i] * size;
        const Ball ball = around.ball(r);
        if (ball.count < 5)
            continue;
        const Eigen::Vector3d spread =
            Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(ball.second / ball.count, Eigen::EigenvaluesOnly)
                .eigenvalues() /
            (r * r);
        result.segment<4>(4 * static_cast<int>(i)) << ball.count * share / (pi * r * r) / 2,
            ball.first.dot(normal) / ball.count / r * 2, spread[0] * 4, spread[1] * 4;
    }
    return result;
}

} // namespace

Points spread_points(const SurfaceSamples& samples, int count)
{
    Points some; // every third: farthest points of all take long, and gain nothing
    for (std::size_t i = 0; i < samples.points.size(); i += 3)
        some.push_back(samples.points[i]);
    Points result;
    for (const int i : farthest_points(some, count).chosen)
        result.push_back(some[i]);
    return result;
}

Features features_of(const SurfaceSamples& samples, double area, const Points& points, const std::vector<double>& sizes,
                     double side)
{
    Features features;
    features.points = points;
    const double share = area / static_cast<double>(samples.points.size());
    const int found = static_cast<int>(features.points.size());
    features.normals.resize(found);
    features.descriptors.assign(sizes.size(), std::vector<Descriptor>(found));
    for_chunks(found, 16, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            const Surroundings around(samples, features.points[i], radii.back() * sizes.back());
            for (std::size_t s = 0; s < sizes.size(); ++s) {
                const Point normal = side * around.ball(normal_radius * sizes[s]).normal.normalized();
                features.descriptors[s][i] = describe(around, sizes[s], normal, share);
                if (s == sizes.size() / 2)
                    features.normals[i] = normal;
            }
        }
    });
    return features;
}

} // namespace vcg_ext
