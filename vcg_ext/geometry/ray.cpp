// SPDX-License-Identifier: GPL-3.0-or-later
#include "ray.h"

#include "../base/vcg_point.h"

#include <vcg/space/intersection3.h>

namespace vcg_ext {

std::optional<SurfacePoint> farthest_hit(const Surface& surface, const Point& origin, const Point& direction)
{
    const Point unit = direction.normalized();
    const vcg::Ray3d ray(to_vcg(origin), to_vcg(unit));
    int face = -1;
    double farthest = -1;
    for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
        const auto& [a, b, c] = surface.triangles[f];
        double distance = 0;
        double u = 0;
        double v = 0;
        if (vcg::IntersectionRayTriangle(ray, to_vcg(surface.points[a]), to_vcg(surface.points[b]),
                                         to_vcg(surface.points[c]), distance, u, v) &&
            distance > farthest) {
            farthest = distance;
            face = static_cast<int>(f);
        }
    }
    if (face < 0)
        return std::nullopt;
    return SurfacePoint{face, origin + farthest * unit};
}

} // namespace vcg_ext
