// SPDX-License-Identifier: GPL-3.0-or-later
#include "affine.h"

#include "../key/random.h"
#include "../key/stream.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

namespace vcg_ext {

Points affine(const Points& points, double amount, std::uint64_t seed)
{
    const Eigen::AlignedBox3d box = bounding_box(points);
    Stream stream = seeded_stream(seed, "affine");
    Eigen::Matrix3d change;
    for (double& entry : change.reshaped())
        entry = 2 * uniform(stream) - 1;
    change *= amount / Eigen::JacobiSVD<Eigen::Matrix3d>(change).singularValues()[0];

    const Point centre = box.center();
    Points result = points;
    for (Point& p : result)
        p += change * (p - centre);
    return result;
}

} // namespace vcg_ext
