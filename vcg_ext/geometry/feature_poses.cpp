// SPDX-License-Identifier: GPL-3.0-or-later
#include "feature_poses.h"

#include "../base/parallel.h"
#include "../key/random.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vcg_ext {

namespace {

constexpr int candidates = 8;           ///< features of the surface that one of the original may be
constexpr double side_tolerance = 1.12; ///< of three sides' ratios
constexpr double scale_tolerance = 0.12;
constexpr double least_cosine = 0.3; ///< between normals of a pair

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

/// Takes the triple's corners of the surface to those of the original. \param size of the surface over the original
Eigen::Affine3d pose_of(const std::array<Point, 3>& to, const std::array<Point, 3>& from, const Eigen::Matrix3d& turn,
                        double size)
{
    Eigen::Affine3d pose = Eigen::Affine3d::Identity();
    pose.linear() = turn / size;
    pose.translation() = (to[0] + to[1] + to[2]) / 3 - pose.linear() * ((from[0] + from[1] + from[2]) / 3);
    return pose;
}

/// Whether the turned normals of the surface look as those of the original do.
bool normals_agree(const Triple& triple, const Features& original, const Features& surface, const Eigen::Matrix3d& turn)
{
    double cosine = 1;
    for (int k = 0; k < 3; ++k)
        cosine =
            std::min(cosine, (turn * surface.normals[triple.surface[k]]).dot(original.normals[triple.original[k]]));
    return cosine > least_cosine;
}

bool nearer(const FeaturePose& a, const FeaturePose& b)
{
    return a.nearness > b.nearness;
}

/// Keeps the `most` nearest, the nearest first; of equal ones those that came first.
void take_if_near(const Eigen::Affine3d& pose, const NearnessGrid& near, const Points& samples, int most,
                  std::vector<FeaturePose>& best)
{
    const bool full = static_cast<int>(best.size()) == most;
    const FeaturePose found{mean_nearness(near, samples, pose, full ? best.back().nearness : 0), pose};
    if (full && !(found.nearness > best.back().nearness))
        return;
    if (full)
        best.pop_back();
    best.insert(std::upper_bound(best.begin(), best.end(), found, nearer), found);
}

} // namespace

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
                if (normals_agree(triple, original, surface, turn))
                    take_if_near(pose_of(to, from, turn, size), near, samples, options.poses, partial[begin / chunk]);
            }
        }
    });
    std::vector<FeaturePose> all;
    for (const auto& part : partial)
        all.insert(all.end(), part.begin(), part.end());
    std::stable_sort(all.begin(), all.end(), nearer);
    if (static_cast<int>(all.size()) > options.poses)
        all.resize(options.poses);
    return all;
}

} // namespace vcg_ext
