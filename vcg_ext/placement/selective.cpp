// SPDX-License-Identifier: GPL-3.0-or-later
#include "selective.h"

#include "../base/vcg_point.h"
#include "../geometry/nearest.h"
#include "radial.h"

#include <cmath>
#include <limits>
#include <vcg/math/quadric.h>

namespace vcg_ext {

namespace {

/// The point between `from` and `to` whose distance from the centre is `norm`.
Point on_the_way(const Point& from, const Point& to, const Point& centre, double norm)
{
    const Point start = from - centre;
    const Point way = to - from;
    const double a = way.squaredNorm();
    const double b = start.dot(way);
    const double c = start.squaredNorm() - norm * norm;
    const double root = std::sqrt(std::max(0.0, b * b - a * c));
    // The norm grows or falls towards `to`, and accordingly the greater or the smaller root is the first met.
    const double t = c < 0 ? (-b + root) / a : (-b - root) / a;
    return from + std::clamp(t, 0.0, 1.0) * way;
}

/// Quadric of the planes of the faces around `v` (5.18), in coordinates relative to `v`.
vcg::math::Quadric<double> vertex_quadric(const Cover& cover, int v)
{
    vcg::math::Quadric<double> sum;
    sum.SetZero();
    for (const int* f = cover.around.begin(v); f != cover.around.end(v); ++f) {
        vcg::math::Quadric<double> plane;
        plane.ByPlane(vcg::Plane3<double, false>(0, to_vcg(cover.normals[*f])));
        sum += plane;
    }
    return sum;
}

} // namespace

Point selective_candidate(const Point& v, const std::array<Point, 3>& face, const Point& centre, double norm)
{
    const auto squared = [&](const Point& p) { return (p - centre).squaredNorm(); };
    const bool inward = norm * norm < squared(v);
    const Point goal = inward ? Point(centre + nearest_to_origin(face[0] - centre, face[1] - centre, face[2] - centre))
                              : *std::max_element(face.begin(), face.end(), [&](const Point& a, const Point& b) {
                                    return squared(a) < squared(b);
                                });
    const double reach = std::sqrt(squared(goal));
    if (inward ? norm < reach : norm > reach)
        return radial_point(goal, centre, norm);
    const Point reached = goal == v ? v : on_the_way(v, goal, centre, norm);
    return radial_point(reached, centre, norm); // takes off the rounding of the root
}

Point place_selective(const Cover& cover, int v, const Point& centre, double norm)
{
    const vcg::math::Quadric<double> quadric = vertex_quadric(cover, v);
    const Point& here = cover.points[v];
    Point best = radial_point(here, centre, norm);
    double least = std::numeric_limits<double>::infinity();
    for (const int* f = cover.around.begin(v); f != cover.around.end(v); ++f) {
        const Triangle& t = cover.triangles[*f];
        const Point candidate =
            selective_candidate(here, {cover.points[t[0]], cover.points[t[1]], cover.points[t[2]]}, centre, norm);
        const double error = quadric.Apply(to_vcg(candidate - here));
        if (error < least && !folds_around(cover, cover.points, v, candidate)) {
            least = error;
            best = candidate;
        }
    }
    return best;
}

} // namespace vcg_ext
