// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "sampling.h"

#include <Eigen/Core>

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

} // namespace vcg_ext
