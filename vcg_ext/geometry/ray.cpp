// SPDX-License-Identifier: GPL-3.0-or-later
#include "ray.h"

#include "../base/vcg_point.h"

#include <algorithm>
#include <cmath>
#include <vcg/space/intersection3.h>

namespace vcg_ext {

namespace {

/// vcglib passes over faces below 1e-6, whatever the unit of length. A power of two makes the surface large without
/// rounding anything.
double enlargement(const Surface& surface, const Point& origin)
{
    constexpr int large = 24;
    double farthest = 0;
    for (const Point& p : surface.points)
        farthest = std::max(farthest, (p - origin).cwiseAbs().maxCoeff());
    return farthest > 0 ? std::exp2(large - std::ilogb(farthest)) : 1;
}

} // namespace

std::optional<SurfacePoint> farthest_hit(const Surface& surface, const Point& origin, const Point& direction)
{
    const Point unit = direction.normalized();
    const double larger = enlargement(surface, origin);
    const auto enlarged = [&](const Point& p) { return to_vcg(larger * p); };
    const vcg::Ray3d ray(enlarged(origin), to_vcg(unit));
    int face = -1;
    double farthest = -1;
    for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
        const auto& [a, b, c] = surface.triangles[f];
        double distance = 0;
        double u = 0;
        double v = 0;
        if (vcg::IntersectionRayTriangle(ray, enlarged(surface.points[a]), enlarged(surface.points[b]),
                                         enlarged(surface.points[c]), distance, u, v) &&
            distance > farthest) {
            farthest = distance;
            face = static_cast<int>(f);
        }
    }
    if (face < 0)
        return std::nullopt;
    return SurfacePoint{face, origin + farthest / larger * unit};
}

} // namespace vcg_ext
