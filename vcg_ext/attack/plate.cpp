// SPDX-License-Identifier: GPL-3.0-or-later
#include "plate.h"

#include "../base/pi.h"
#include "../key/random.h"
#include "../key/stream.h"

#include <Eigen/Geometry>

namespace vcg_ext {

Surface plate(const Surface& surface, int copies, std::uint64_t seed)
{
    const Eigen::AlignedBox3d box = bounding_box(surface.points);
    const double pitch = 1.1 * box.diagonal().norm(); // no turn makes it wider than its diagonal
    Stream stream = seeded_stream(seed, "plate");
    Surface result;
    for (int copy = 0; copy < copies; ++copy) {
        const Eigen::Matrix3d turn = Eigen::AngleAxisd(2 * pi * uniform(stream), Point::UnitZ()).toRotationMatrix();
        const int first = static_cast<int>(result.points.size());
        for (const Point& p : surface.points)
            result.points.push_back(turn * (p - box.center()) + box.center() + copy * pitch * Point::UnitX());
        for (const Triangle& t : surface.triangles)
            result.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    return result;
}

} // namespace vcg_ext
