// SPDX-License-Identifier: GPL-3.0-or-later
#include "check.h"

#include "error.h"
#include "parallel.h"

#include <algorithm>
#include <string>
#include <utility>

namespace vcg_ext {

namespace {

constexpr double smallest = 1e-35; // for the reasons of largest_coordinate

bool within_largest(const Eigen::AlignedBox3d& box)
{
    return box.min().minCoeff() >= -largest_coordinate && box.max().maxCoeff() <= largest_coordinate;
}

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
    const unsigned highest = ordered_maximum(static_cast<int>(surface.triangles.size()), 0U, [&](int f) {
        const Triangle& t = surface.triangles[f];
        return std::max({static_cast<unsigned>(t[0]), static_cast<unsigned>(t[1]), static_cast<unsigned>(t[2])});
    });
    if (highest >= surface.points.size()) // negative numbers are larger still
        throw Error("A face of the " + std::string(which) + " refers to a vertex that does not exist.");
    const auto spread = [&](const Triangle& t) {
        return bounding_box({surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]}).sizes().maxCoeff();
    };
    const auto has_corners = [&points = surface.points](const Triangle& t) {
        return points[t[0]] != points[t[1]] && points[t[1]] != points[t[2]] && points[t[2]] != points[t[0]];
    };
    const auto proper = std::find_if(surface.triangles.begin(), surface.triangles.end(), has_corners);
    const Eigen::AlignedBox3d around_all = bounding_box(surface.points);
    if (proper != surface.triangles.end() && spread(*proper) >= smallest && within_largest(around_all))
        return; // whichever vertices have faces
    const Eigen::AlignedBox3d box = bounding_box(surface);
    if (!within_largest(box))
        throw Error(mesh + " has coordinates of more than 1e35. Scale it down first.");
    const double size = box.sizes().maxCoeff();
    if (size > 0 && size < smallest)
        throw Error(mesh + " is smaller than 1e-35. Scale it up first.");
    if (proper == surface.triangles.end())
        throw Error("No face of the " + std::string(which) +
                    " has three distinct corners. "
                    "Check its coordinates, or reconstruct the surface.");
}

Welded checked_weld(Surface surface, const char* which)
{
    check_surface(surface, which);
    return weld(std::move(surface));
}

} // namespace vcg_ext
