// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "feet.h"
#include "sampling.h"

#include <Eigen/Geometry>

namespace vcg_ext {

/// A number for each of four radii and four measures of the shape around a point: the area inside the ball, how far its
/// centroid lies along the normal, and the two lesser eigenvalues of its second moments, each over the flat disc's.
/// The same for a mirror image.
using Descriptor = Eigen::Matrix<double, 16, 1>;

/// Points of a surface that are spread over it, with normals, and descriptors for each of several sizes of the balls.
struct Features {
    Points points;
    Points normals;                                   ///< means over the smallest ball
    std::vector<std::vector<Descriptor>> descriptors; ///< by size, then by point
};

/// Points that are spread over a surface, of its samples.
[[nodiscard]] Points spread_points(const SurfaceSamples& samples, int count);

/// \param samples of the surface, each for the same share of `area`
/// \param sizes what the balls' radii are shares of, ascending: see Descriptor
/// \param side  -1 where the normals look in
[[nodiscard]] Features features_of(const SurfaceSamples& samples, double area, const Points& points,
                                   const std::vector<double>& sizes, double side);

/// How near to a surface a point is, roughly: distances at the middles of a grid's cells.
class NearnessGrid {
public:
    /// \param reach further away than this is all alike
    NearnessGrid(const FootSearch& surface, double reach);

    /// 1 on the surface, 0 from `reach` on.
    [[nodiscard]] double operator()(const Point& p) const;

private:
    static constexpr int cells = 48; ///< along the longest side
    double cell_ = 0;
    Point corner_ = Point::Zero();
    std::array<int, 3> count_{};
    std::vector<float> nearness_;
};

/// A pose that three pairs of features speak for.
struct FeaturePose {
    double nearness = 0; ///< mean over the surface's samples
    Eigen::Affine3d pose = Eigen::Affine3d::Identity();
};

struct FeatureOptions {
    int triples = 150000;  ///< that are drawn
    int poses = 6;         ///< that are given back
    double least_side = 0; ///< of the triangle of three features of the original
    std::uint64_t draw = 0;
};

/// Similarities and mirror images that take features of a surface to such of the original that look alike, by random
/// triples (RANSAC): the best by where they take the samples.
///
/// \param place which of the surface's sizes, and `scale` the surface's size over the original's that it stands for
/// \return the nearest first
[[nodiscard]] std::vector<FeaturePose> poses_by_features(const Features& original, const Features& surface,
                                                         std::size_t place, double scale, const NearnessGrid& near,
                                                         const Points& samples, const FeatureOptions& options);

} // namespace vcg_ext
