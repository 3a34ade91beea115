// SPDX-License-Identifier: GPL-3.0-or-later
#include "wave_flows.h"

#include "../base/median.h"
#include "../base/parallel.h"
#include "../geometry/laplacian.h"

#include <algorithm>
#include <cmath>

namespace vcg_ext {

namespace {

/// The body's surface without fans.
Surface surface_of(const WaveBody& body)
{
    const auto& triangles = body.topology.triangles;
    return {{body.points.begin(), body.points.begin() + body.topology.sites},
            {triangles.begin(), triangles.begin() + body.topology.surface_triangles}};
}

void to_unit_rms(std::vector<double>& flow)
{
    const double squares = ordered_sum(static_cast<int>(flow.size()), 0.0, [&](int v) { return flow[v] * flow[v]; });
    const double size = std::sqrt(squares / std::max<std::size_t>(1, flow.size()));
    for (double& w : flow)
        w *= size > 0 ? 1 / size : 0;
}

} // namespace

Points site_normals(const WaveBody& body)
{
    const auto& triangles = body.topology.triangles;
    const double outward = body.frame.measure < 0 ? -1 : 1;
    Points normals(body.topology.sites, Point::Zero());
    for (int f = 0; f < body.topology.surface_triangles; ++f) {
        const Point n = outward * scaled_normal(body.points, triangles[f]);
        for (const int v : triangles[f])
            normals[v] += n;
    }
    for (Point& n : normals)
        if (const double length = n.norm(); length > 0)
            n /= length;
    return normals;
}

std::vector<std::vector<double>> processing_flows(const WaveBody& body, const Points& normals)
{
    const Surface surface = surface_of(body);
    const int sites = body.topology.sites;
    std::vector<double> area(sites, 0);
    Points bend(sites, Point::Zero()); // integral of the mean curvature's normal: sum of cotangents / 2 (v - w)
    for (const Triangle& t : surface.triangles) {
        const double doubled = scaled_normal(surface.points, t).norm();
        for (int k = 0; k < 3; ++k) {
            const int i = t[(k + 1) % 3];
            const int j = t[(k + 2) % 3];
            const Point u = surface.points[i] - surface.points[t[k]];
            const Point v = surface.points[j] - surface.points[t[k]];
            const double cotangent = std::clamp(u.dot(v) / std::max(doubled, 1e-300), -20.0, 20.0);
            const Point d = cotangent / 2 * (surface.points[i] - surface.points[j]);
            bend[i] += d;
            bend[j] -= d;
            area[t[k]] += doubled / 6;
        }
    }
    const double most = 1 / std::sqrt(std::max(median(area), 1e-12));
    const EdgeGraph graph = edge_graph(surface);
    std::vector<double> curvature(sites, 0);
    std::vector<double> umbrella(sites, 0);
    for_each_index(sites, [&](int v) {
        if (area[v] > 0)
            curvature[v] = std::clamp(bend[v].dot(normals[v]) / area[v], -most, most);
        if (graph.degree(v) > 0)
            umbrella[v] = -laplacian_row(graph, surface.points, v).dot(normals[v]) / graph.degree(v);
    });
    to_unit_rms(curvature);
    to_unit_rms(umbrella);
    return {curvature, umbrella};
}

std::vector<Points> umbrella_powers(const WaveBody& body, int n)
{
    const Surface surface = surface_of(body);
    const EdgeGraph graph = edge_graph(surface);
    std::vector<Points> powers;
    for (int j = 0; j < n; ++j) {
        const Points& last = j == 0 ? surface.points : powers.back();
        Points next(last.size(), Point::Zero());
        for_each_index(graph.vertices(), [&](int v) {
            if (graph.degree(v) > 0)
                next[v] = -laplacian_row(graph, last, v) / graph.degree(v);
        });
        powers.push_back(std::move(next));
    }
    return powers;
}

Points before_smoothing(const WaveBody& body, const std::vector<Points>& powers, double lambda, double s)
{
    Points points = body.points;
    double factor = 1;
    for (std::size_t j = 0; j < powers.size(); ++j) {
        factor *= -(s + j * lambda) / (j + 1.0);
        for_each_index(body.topology.sites, [&](int v) { points[v] += factor * powers[j][v]; });
    }
    place_apexes(body.topology, points);
    return points;
}

} // namespace vcg_ext
