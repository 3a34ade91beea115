// SPDX-License-Identifier: GPL-3.0-or-later
#include "similarity.h"

#include "../key/random.h"
#include "../key/stream.h"

#include <Eigen/Geometry>

namespace vcg_ext {

Points similarity(const Points& points, std::uint64_t seed)
{
    const Eigen::AlignedBox3d box = bounding_box(points);
    Stream stream = seeded_stream(seed, "similarity");
    const Eigen::Matrix3d rotation = Eigen::Quaterniond(direction<4>(stream)).toRotationMatrix();
    const double scale = 0.5 + 1.5 * uniform(stream);
    const double diagonal = box.diagonal().norm();
    Point shift;
    for (double& x : shift)
        x = (2 * uniform(stream) - 1) * diagonal;

    const Point centre = box.center();
    Points result = points;
    for (Point& p : result)
        p = scale * (rotation * (p - centre)) + centre + shift;
    return result;
}

} // namespace vcg_ext
