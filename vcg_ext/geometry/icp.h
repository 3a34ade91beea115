// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "feet.h"
#include "sampling.h"

#include <Eigen/Geometry>

namespace vcg_ext {

struct IcpOptions {
    int iterations = 12;
    bool affine = false;      ///< 12 unknowns, else 7
    double first_reach = 0;   ///< of feet, in the original's unit;
    double last_reach = 0;    ///< falls by .7 from step to step, down to this
    double least_cosine = .3; ///< between the normals of a sample and of the face at its foot
};

/// Moves `pose` so that samples come to lie on the original: iteratively reweighted least squares of their distances
/// from the planes at their feet. Feet on the border do not count.
///
/// \param count of the samples, from the first of them on: how many take part
/// \return whether enough of them had feet; else the pose is as it was
bool refine_pose(const FootSearch& original, const SurfaceSamples& samples, int count, const IcpOptions& options,
                 Eigen::Affine3d& pose);

/// Feet of the first `count` samples under a pose.
[[nodiscard]] std::vector<Foot> feet_of(const FootSearch& original, const Points& points, int count,
                                        const Eigen::Affine3d& pose, double reach);

/// -1 where most samples under `pose` look into the original where it looks out, else 1.
[[nodiscard]] double side_of(const FootSearch& original, const SurfaceSamples& samples, const std::vector<Foot>& feet,
                             const Eigen::Affine3d& pose);

} // namespace vcg_ext
