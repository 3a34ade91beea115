#include "ray.h"

#include <vcg/space/intersection3.h>

namespace vcg_ext {

std::optional<SurfacePoint> farthest_hit(const Surface& surface, const Point& origin, const Point& direction)
{
    const auto vcg_point = [](const Point& p) { return vcg::Point3d(p.x(), p.y(), p.z()); };
    const Point unit = direction.normalized();
    const vcg::Ray3d ray(vcg_point(origin), vcg_point(unit));
    int face = -1;
    double farthest = -1;
    for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
        const auto& [a, b, c] = surface.triangles[f];
        double distance = 0;
        double u = 0;
        double v = 0;
        if (vcg::IntersectionRayTriangle(ray, vcg_point(surface.points[a]), vcg_point(surface.points[b]),
                                         vcg_point(surface.points[c]), distance, u, v) &&
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
