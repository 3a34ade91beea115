// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid.h"

#include "../base/parallel.h"
#include "../base/pi.h"
#include "boundary.h"
#include "sets.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace vcg_ext {

namespace {

/// Whether there is a solid to speak of. Where the surface is as good as flat, or bounds as much on the one side as on
/// the other, the volume nearly cancels, and its moments over it are anything.
bool is_body(const Frame& solid, const Frame& surface)
{
    if (!(std::abs(solid.measure) > 1e-3 * std::pow(surface.measure, 1.5)))
        return false;
    const double spread = surface.variances.sum();
    const double share = solid.variances.sum() / spread;
    return share > 0.2 && share < 1.2 && (solid.centre - surface.centre).squaredNorm() < spread / 2;
}

} // namespace

HoleFans hole_fans(const Surface& surface)
{
    HoleFans result;
    result.sites = static_cast<int>(surface.points.size());
    const std::vector<EdgeUse> edges = boundary(surface);
    result.orientable = std::none_of(edges.begin(), edges.end(), [](const EdgeUse& e) { return e.faces == 2; });
    if (!result.orientable)
        return result;
    Sets pieces(edges.empty() ? 0 : result.sites);
    for (const EdgeUse& e : edges)
        pieces.join(e.low, e.high);
    std::vector<int> apex_of(edges.empty() ? 0 : result.sites, -1);
    for (const EdgeUse& e : edges) {
        int& apex = apex_of[pieces.of(e.low)];
        if (apex < 0)
            apex = result.sites + result.apexes++;
        for (int i = 0; i < std::abs(e.balance); ++i) {
            const int from = e.balance > 0 ? e.low : e.high;
            const int to = e.balance > 0 ? e.high : e.low;
            result.rims.push_back({from, to, apex});
            result.fans.push_back({to, from, apex});
        }
    }
    return result;
}

SolidTopology solid_topology(const Surface& surface)
{
    SolidTopology result{hole_fans(surface), surface.triangles, static_cast<int>(surface.triangles.size())};
    result.triangles.insert(result.triangles.end(), result.fans.begin(), result.fans.end());
    return result;
}

Points solid_points(const HoleFans& holes, const Points& vertices)
{
    Points points(holes.points());
    for_each_index(holes.sites, [&](int v) { points[v] = vertices[v]; });
    place_apexes(holes, points);
    return points;
}

void place_apexes(const HoleFans& holes, Points& points)
{
    std::fill(points.begin() + holes.sites, points.end(), Point::Zero());
    std::vector<double> length(holes.apexes, 0);
    for (const auto& [from, to, apex] : holes.rims) {
        const double l = (points[to] - points[from]).norm();
        points[apex] += l * (points[to] + points[from]) / 2;
        length[apex - holes.sites] += l;
    }
    for (int a = 0; a < holes.apexes; ++a)
        if (length[a] > 0)
            points[holes.sites + a] /= length[a];
}

Frame principal_frame(const Points& points, const SolidTopology& topology)
{
    Frame surface = area_frame(points, topology.triangles);
    if (!topology.orientable)
        return surface;
    Frame solid = solid_frame(points, topology.triangles);
    return is_body(solid, surface) ? solid : surface;
}

Frame principal_frame(const Surface& surface)
{
    const SolidTopology topology = solid_topology(surface);
    return principal_frame(solid_points(topology, surface.points), topology);
}

void align_axes(Frame& frame, const Eigen::Matrix3d& like)
{
    // The axis that is the most sure takes its place first.
    const Frame old = frame;
    Eigen::Matrix3d overlap = like.transpose() * old.axes;
    for (int round = 0; round < 3; ++round) {
        int to = 0;
        int from = 0;
        overlap.cwiseAbs().maxCoeff(&to, &from);
        const double sign = overlap(to, from) < 0 ? -1 : 1;
        frame.axes.col(to) = sign * old.axes.col(from);
        frame.third_moments[to] = sign * old.third_moments[from];
        frame.variances[to] = old.variances[from];
        overlap.row(to).setZero();
        overlap.col(from).setZero();
    }
}

double ball_radius(const Frame& frame)
{
    return std::cbrt(3 * std::abs(frame.measure) / (4 * pi));
}

std::array<double, 2> angular_moment(const Points& points, const std::vector<Triangle>& triangles, const Frame& frame,
                                     int first, int second, int n)
{
    using Complex = std::complex<double>;
    const double r = ball_radius(frame);
    const Point u = frame.axes.col(first) / r;
    const Point v = frame.axes.col(second) / r;
    const Complex sum = ordered_sum(static_cast<int>(triangles.size()), Complex(0), [&](int f) {
        Complex h[17] = {1}; // complete homogeneous polynomials of the corners so far; the fourth corner is 0
        Eigen::Matrix3d p;
        for (int corner = 0; corner < 3; ++corner) {
            p.col(corner) = points[triangles[f][corner]] - frame.centre;
            const Complex z(u.dot(p.col(corner)), v.dot(p.col(corner)));
            for (int k = 1; k <= n; ++k)
                h[k] += z * h[k - 1];
        }
        return p.col(0).dot(p.col(1).cross(p.col(2))) / 6 * h[n];
    });
    const double binomial = (n + 1.0) * (n + 2.0) * (n + 3.0) / 6;
    const Complex mean = sum / (binomial * frame.measure);
    return {mean.real(), mean.imag()};
}

} // namespace vcg_ext
