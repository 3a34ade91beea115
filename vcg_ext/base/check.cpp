// SPDX-License-Identifier: GPL-3.0-or-later
#include "check.h"

#include "error.h"
#include "parallel.h"

#include <algorithm>
#include <string>

namespace vcg_ext {

namespace {

// Moments go with the sixth power of the size, quadrics' determinants with the twelfth of it over its square.
constexpr double largest = 1e35;
constexpr double smallest = 1e-35;

} // namespace

void check_surface(const Surface& surface, const char* which)
{
    const std::string mesh = std::string("The ") + which;
    const auto vertices = static_cast<int>(surface.points.size());
    const int not_finite = ordered_sum(vertices, 0, [&](int v) { return !surface.points[v].allFinite(); });
    if (not_finite > 0)
        throw Error(std::to_string(not_finite) + " of the " + std::to_string(surface.points.size()) +
                    " vertices have coordinates that are no finite numbers. Remove these vertices first.");
    if (surface.triangles.empty())
        throw Error(mesh + " has no faces, so there is no surface. "
                           "Open a mesh with faces, or reconstruct the surface.");
    struct Seen {
        bool outside = false;
        Eigen::AlignedBox3d box;
    };
    const auto [outside, box] = ordered_fold(
        static_cast<int>(surface.triangles.size()), Seen(),
        [&](Seen& seen, int f) {
            for (const int v : surface.triangles[f]) {
                if (v < 0 || v >= vertices)
                    seen.outside = true;
                else
                    seen.box.extend(surface.points[v]);
            }
        },
        [](Seen& seen, const Seen& part) {
            seen.outside = seen.outside || part.outside;
            seen.box.extend(part.box);
        });
    if (outside)
        throw Error("A face of the " + std::string(which) + " refers to a vertex that does not exist.");
    if (box.min().minCoeff() < -largest || box.max().maxCoeff() > largest)
        throw Error(mesh + " has coordinates of more than 1e35. Scale it down first.");
    const double size = box.sizes().maxCoeff();
    if (size > 0 && size < smallest)
        throw Error(mesh + " is smaller than 1e-35. Scale it up first.");
    const auto has_corners = [&points = surface.points](const Triangle& t) {
        return points[t[0]] != points[t[1]] && points[t[1]] != points[t[2]] && points[t[2]] != points[t[0]];
    };
    if (std::none_of(surface.triangles.begin(), surface.triangles.end(), has_corners))
        throw Error("No face of the " + std::string(which) +
                    " has three distinct corners. "
                    "Check its coordinates, or reconstruct the surface.");
}

Welded checked_weld(const Surface& surface, const char* which)
{
    check_surface(surface, which);
    return weld(surface);
}

} // namespace vcg_ext
