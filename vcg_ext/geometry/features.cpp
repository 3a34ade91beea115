// SPDX-License-Identifier: GPL-3.0-or-later
#include "features.h"

#include "../base/parallel.h"
#include "../base/pi.h"
#include "../key/random.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace vcg_ext {

namespace {

constexpr std::array<double, 4> radii = {0.03, 0.05, 0.08, 0.12};
constexpr double normal_radius = 0.02;
constexpr int candidates = 8;           ///< features of the surface that one of the original may be
constexpr double side_tolerance = 1.12; ///< of three sides' ratios
constexpr double scale_tolerance = 0.12;
constexpr double least_cosine = 0.3; ///< between normals of a pair

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

/// Per feature of the original the features of the surface that look most like it.
std::vector<std::array<int, candidates>> matches(const std::vector<Descriptor>& original,
                                                 const std::vector<Descriptor>& surface)
{
    std::vector<std::array<int, candidates>> result(original.size());
    for_chunks(static_cast<int>(original.size()), 16, [&](int begin, int end) {
        std::vector<std::pair<double, int>> likeness(surface.size());
        for (int i = begin; i < end; ++i) {
            for (std::size_t j = 0; j < surface.size(); ++j)
                likeness[j] = {(original[i] - surface[j]).squaredNorm(), static_cast<int>(j)};
            std::partial_sort(likeness.begin(), likeness.begin() + candidates, likeness.end());
            for (int k = 0; k < candidates; ++k)
                result[i][k] = likeness[k].second;
        }
    });
    return result;
}

/// Orthonormal axes of a triangle: along its first side, in its plane, across; these may be a left hand's.
Eigen::Matrix3d axes_of(const std::array<Point, 3>& corner, double hand)
{
    Eigen::Matrix3d axes;
    axes.col(0) = (corner[1] - corner[0]).normalized();
    axes.col(2) = axes.col(0).cross(corner[2] - corner[0]).normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    axes.col(2) *= hand;
    return axes;
}

/// Three features of the original, and what they may be on the surface.
struct Triple {
    std::array<int, 3> original;
    std::array<int, 3> surface;
};

/// The candidate's number: 0 the most often, each further one less, by a geometric law of .7.
int draw_rank(Stream& draws)
{
    int rank = 0;
    while (rank + 1 < candidates && draws.below(10) < 7)
        ++rank;
    return rank;
}

/// Scale of the surface over the original as the triple's sides say; 0 where they disagree.
double scale_of(const std::array<Point, 3>& original, const std::array<Point, 3>& surface, double least_side)
{
    double least = 1e300;
    double most = 0;
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const double side = (original[k] - original[(k + 1) % 3]).norm();
        if (side < least_side)
            return 0;
        const double ratio = (surface[k] - surface[(k + 1) % 3]).norm() / side;
        least = std::min(least, ratio);
        most = std::max(most, ratio);
        sum += ratio;
    }
    return most < side_tolerance * least ? sum / 3 : 0;
}

template <class T>
std::array<T, 3> pick(const std::vector<T>& all, const std::array<int, 3>& which)
{
    return {all[which[0]], all[which[1]], all[which[2]]};
}

double mean_nearness(const NearnessGrid& near, const Points& samples, const Eigen::Affine3d& pose, double to_beat)
{
    const int count = static_cast<int>(samples.size());
    double sum = 0;
    for (int i = 0; i < count; ++i) {
        sum += near(pose * samples[i]);
        if (sum + (count - 1 - i) < to_beat * count)
            return 0; // not even if all others were on the surface
    }
    return sum / count;
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

NearnessGrid::NearnessGrid(const FootSearch& surface, double reach)
{
    const Eigen::AlignedBox3d box = bounding_box(surface.surface());
    cell_ = (box.sizes().maxCoeff() + 2 * reach) / cells;
    corner_ = box.min() - Point::Constant(reach);
    std::size_t all = 1;
    for (int k = 0; k < 3; ++k) {
        count_[k] = static_cast<int>(std::ceil((box.sizes()[k] + 2 * reach) / cell_)) + 1;
        all *= count_[k];
    }
    nearness_.resize(all);
    for_chunks(static_cast<int>(all), 1024, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            const int x = i % count_[0];
            const int y = i / count_[0] % count_[1];
            const int z = i / (count_[0] * count_[1]);
            const Point middle = corner_ + cell_ * Point(x + 0.5, y + 0.5, z + 0.5);
            const Foot foot = surface(middle, reach);
            nearness_[i] = foot.face < 0 ? 0 : static_cast<float>(std::max(0.0, 1 - foot.distance / reach));
        }
    });
}

double NearnessGrid::operator()(const Point& p) const
{
    std::array<int, 3> at;
    for (int k = 0; k < 3; ++k) {
        const double place = (p[k] - corner_[k]) / cell_;
        if (!(place >= 0 && place < count_[k]))
            return 0;
        at[k] = static_cast<int>(place);
    }
    return nearness_[(static_cast<std::size_t>(at[2]) * count_[1] + at[1]) * count_[0] + at[0]];
}

std::vector<FeaturePose> poses_by_features(const Features& original, const Features& surface, std::size_t place,
                                           double scale, const NearnessGrid& near, const Points& samples,
                                           const FeatureOptions& options)
{
    constexpr int chunk = 5000;
    if (static_cast<int>(surface.points.size()) < candidates || original.points.size() < 3)
        return {};
    const auto like = matches(original.descriptors.front(), surface.descriptors[place]);
    std::vector<std::vector<FeaturePose>> partial(chunk_count(options.triples, chunk));
    for_chunks(options.triples, chunk, [&](int begin, int end) {
        Stream draws = seeded_stream(options.draw, "feature triples", begin / chunk);
        std::vector<FeaturePose>& best = partial[begin / chunk];
        for (int i = begin; i < end; ++i) {
            Triple triple;
            for (int k = 0; k < 3; ++k) {
                triple.original[k] = static_cast<int>(draws.below(original.points.size()));
                triple.surface[k] = like[triple.original[k]][draw_rank(draws)];
            }
            const auto to = pick(original.points, triple.original);
            const auto from = pick(surface.points, triple.surface);
            const double size = scale_of(to, from, options.least_side);
            if (!(size > 0) || std::abs(std::log(size / scale)) > scale_tolerance)
                continue;
            for (const double hand : {1.0, -1.0}) {
                const Eigen::Matrix3d turn = axes_of(to, hand) * axes_of(from, 1).transpose();
                double cosine = 1;
                for (int k = 0; k < 3; ++k)
                    cosine = std::min(
                        cosine, (turn * surface.normals[triple.surface[k]]).dot(original.normals[triple.original[k]]));
                if (!(cosine > least_cosine))
                    continue;
                FeaturePose found;
                found.pose.linear() = turn / size;
                found.pose.translation() =
                    (to[0] + to[1] + to[2]) / 3 - found.pose.linear() * ((from[0] + from[1] + from[2]) / 3);
                const bool full = static_cast<int>(best.size()) == options.poses;
                found.nearness = mean_nearness(near, samples, found.pose, full ? best.back().nearness : 0);
                if (full && !(found.nearness > best.back().nearness))
                    continue;
                if (full)
                    best.pop_back();
                best.insert(std::upper_bound(
                                best.begin(), best.end(), found,
                                [](const FeaturePose& a, const FeaturePose& b) { return a.nearness > b.nearness; }),
                            found);
            }
        }
    });
    std::vector<FeaturePose> all;
    for (const auto& part : partial)
        all.insert(all.end(), part.begin(), part.end());
    std::stable_sort(all.begin(), all.end(),
                     [](const FeaturePose& a, const FeaturePose& b) { return a.nearness > b.nearness; });
    if (static_cast<int>(all.size()) > options.poses)
        all.resize(options.poses);
    return all;
}

} // namespace vcg_ext
