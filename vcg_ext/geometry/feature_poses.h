// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "features.h"
#include "nearness_grid.h"

#include <Eigen/Geometry>

namespace vcg_ext {

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
