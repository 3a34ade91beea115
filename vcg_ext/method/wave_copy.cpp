// SPDX-License-Identifier: GPL-3.0-or-later
#include "wave_copy.h"

#include "../base/parallel.h"
#include "../carrier/wave_flows.h"
#include "../geometry/boundary.h"
#include "../geometry/normals.h"
#include "../geometry/umbrella.h"
#include "../geometry/wave_values.h"
#include "../key/random.h"
#include "smoothed_original.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vcg_ext {

namespace {

constexpr int most_vertices = 40000; ///< of the copy that are looked at
constexpr int area_samples = 12000;
constexpr int points_of_impression = 3000;
constexpr double reach = 0.1;          ///< of feet, in radii
constexpr double least_cosine = -0.2;  ///< between the normals of copy and original
constexpr double least_flatness = 0.8; ///< cosine between a face's normal and the mean of those around: no sharp edges

/// Per vertex twice the area of the faces around it.
std::vector<double> areas_around(const Surface& surface)
{
    std::vector<double> area(surface.points.size(), 0);
    for (const Triangle& t : surface.triangles)
        for (const int v : t)
            area[v] += scaled_normal(surface.points, t).norm();
    return area;
}

/// Where a copy is looked at, laid on its original.
struct Samples {
    Points points;
    Points normals;
    std::vector<int> kind;     ///< 0: a vertex, 1: a place on a face
    std::vector<double> areas; ///< of what the sample stands for, in any unit for each kind
};

Samples samples_of(const Surface& surface, const Registration& registration)
{
    const Points vertex_normal = vertex_normals(surface.points, surface.triangles);
    const std::vector<double> area = areas_around(surface);
    Samples samples;
    const auto add = [&](const Point& p, const Point& n, int kind, double a) {
        samples.points.push_back(p);
        samples.normals.push_back(n);
        samples.kind.push_back(kind);
        samples.areas.push_back(a);
    };
    std::vector<int> chosen;
    if (static_cast<int>(surface.points.size()) <= most_vertices) {
        for (std::size_t v = 0; v < surface.points.size(); ++v)
            chosen.push_back(static_cast<int>(v));
    } else {
        chosen = seeded_stream(0, "copy vertices").permutation(static_cast<int>(surface.points.size()));
        chosen.resize(most_vertices);
    }
    for (const int v : chosen)
        add(surface.points[v], vertex_normal[v], 0, area[v]);
    const SurfaceSamples places = sample_surface(surface, area_samples, "copy surface");
    for (int i = 0; i < area_samples; ++i)
        add(places.points[i], places.normals[i], 1,
            scaled_normal(surface.points, surface.triangles[places.faces[i]]).norm());

    const Eigen::Affine3d& pose = registration.affine;
    const Eigen::Matrix3d turn = pose.linear().inverse().transpose() * (registration.inside_out ? -1 : 1);
    for_each_index(static_cast<int>(samples.points.size()), [&](int i) {
        samples.points[i] = pose * samples.points[i];
        samples.normals[i] = (turn * samples.normals[i]).normalized();
    });
    return samples;
}

/// 1 where the normals of the mesh point outward, -1 where they point inward.
double side_of(const WaveBody& body)
{
    return body.frame.measure < 0 ? -1 : 1;
}

/// A place of the mesh in the body's own coordinates.
Point in_radii(const WaveBody& body, const Point& p)
{
    return body.frame.axes.transpose() * (p - body.frame.centre) / body.radius;
}

/// A normal of the mesh in the body's own coordinates, outward.
Point outward(const WaveBody& body, const Point& normal)
{
    return body.frame.axes.transpose() * normal * side_of(body);
}

/// How processing may have moved the sites, along their normals: by processing_flows(), and by some rounds more.
std::vector<std::vector<double>> flows_of(const WaveBody& now, const Points& normals, const EdgeGraph& graph,
                                          int rounds)
{
    std::vector<std::vector<double>> flows = processing_flows(now, normals);
    if (rounds > 0) {
        const int sites = now.topology.sites;
        const Points later = umbrella_steps(graph, Points(now.points.begin(), now.points.begin() + sites), 0.5,
                                            std::max(1, rounds / 10));
        std::vector<double> flow(sites);
        for (int v = 0; v < sites; ++v)
            flow[v] = (later[v] - now.points[v]).dot(normals[v]);
        flows.push_back(std::move(flow));
    }
    return flows;
}

/// Where a sample stands on the original, and how far it lies off it: in radii, outward positive. No foot where it tells
/// nothing: nothing is near, or looks the same way, or it is a sharp edge.
struct Offset {
    Foot foot;
    double distance = 0;
};

std::vector<Offset> offsets_of(const Samples& samples, const FootSearch& feet, const Points& vertex_normals,
                               const WaveBody& body)
{
    const int count = static_cast<int>(samples.points.size());
    std::vector<Offset> offsets(count);
    for_chunks(count, 512, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            const Foot foot = feet(samples.points[i], reach * body.radius);
            if (foot.face < 0 || foot.on_rim)
                continue;
            const Point n = outward(body, feet.normals()[foot.face]);
            const Point mean = at_foot(vertex_normals, feet.surface().triangles[foot.face], foot.weights).normalized();
            const Point looks = outward(body, samples.normals[i]);
            if (!(looks.dot(mean) > least_cosine) || !(mean.dot(n) > least_flatness))
                continue;
            const Point way = body.frame.axes.transpose() * (samples.points[i] - foot.point);
            const bool inside = foot.weights.minCoeff() > 1e-9;
            offsets[i] = {foot, (way.dot(inside ? n : mean) < 0 ? -1 : 1) * way.norm() / body.radius};
        }
    });
    return offsets;
}

/// Whether the copy's edges are others than the original's, and not so many that it would take too long.
bool has_own_edges(const Copy& copy)
{
    constexpr std::size_t most = 100000; // vertices
    const Surface& original = copy.registrar.original().surface();
    const Surface& surface = copy.surface;
    return surface.points.size() <= most &&
           (surface.points.size() != original.points.size() || surface.triangles.size() != original.triangles.size());
}

/// The vertices that have a place on the original, and faces all around.
std::vector<int> inner_vertices(const Unsmoothed& way, const Surface& surface, const EdgeGraph& graph)
{
    const int count = static_cast<int>(surface.points.size());
    std::vector<char> rim(count, 0);
    for (const EdgeUse& edge : boundary(surface))
        rim[edge.low] = rim[edge.high] = 1;
    return indices_where(
        count, [&](int v) { return way.feet[v].face >= 0 && !way.feet[v].on_rim && !rim[v] && graph.degree(v) > 0; });
}

} // namespace

WaveCopy::WaveCopy(const Copy& copy)
    : body_(wave_body(copy.original)), impression_(impression_of(copy.original, points_of_impression)),
      graph_(edge_graph(copy.registrar.original().surface())), directions_(offset_directions(body_))
{
    const SmoothedOriginal smoothed = smoothed_original(copy, body_, graph_);
    State plain;
    plain.registration = copy.registration;
    if (smoothed.rounds == 0) {
        look(copy, copy.registrar.original(), std::move(plain));
        return;
    }
    const bool own_edges = has_own_edges(copy);
    State worn;
    worn.rounds = smoothed.rounds;
    worn.weight = own_edges ? 0.3 : 0.75;
    worn.registration = smoothed.registration;
    plain.weight = own_edges ? 0.1 : 0.25;
    if (own_edges)
        look_before_smoothing(copy, worn);
    look(copy, *smoothed.feet, std::move(worn));
    look(copy, copy.registrar.original(), std::move(plain));
}

void WaveCopy::look_before_smoothing(const Copy& copy, const State& worn)
{
    constexpr double weight = 0.6; // of all ways
    const Surface laid = laid_by(worn.registration.affine, copy.surface, worn.registration);
    copy_graph_ = edge_graph(laid);
    const std::vector<Unsmoothed> ways =
        unsmoothings(copy.registrar.original(), copy.registrar.size(), laid, copy_graph_, worn.rounds);
    for (const Unsmoothed& way : ways)
        add(way, laid, weight / static_cast<double>(ways.size()));
}

void WaveCopy::add(const Unsmoothed& way, const Surface& surface, double weight)
{
    State state;
    state.rounds = way.rounds;
    state.weight = weight;
    state.places = way.feet;
    state.vertices = inner_vertices(way, surface, copy_graph_);

    const std::vector<double> area = areas_around(surface);
    const std::vector<double> curvature = processing_flows(body_, site_normals(body_)).front();
    const Points later = umbrella_step(copy_graph_, way.smoothed, 0.5);
    const auto rows = static_cast<Eigen::Index>(state.vertices.size());
    ResidualField& field = state.field;
    field.floor = floor_of_noise * body_.diagonal / body_.radius;
    field.kind.assign(state.vertices.size(), 0);
    field.residual.resize(rows);
    field.nuisance.resize(rows, 15);
    for (Eigen::Index row = 0; row < rows; ++row) {
        const int v = state.vertices[row];
        const Point n = outward(body_, way.normals[v]);
        const Point p = in_radii(body_, way.smoothed[v]);
        const double bend = at_foot(curvature, body_.topology.triangles[way.feet[v].face], way.feet[v].weights);
        field.residual[row] = side_of(body_) * (way.laid[v] - way.smoothed[v]).dot(way.normals[v]) / body_.radius;
        field.places.push_back(p);
        field.roughness.push_back(std::abs(bend) * area[v]);
        state.normals.push_back(n);
        auto z = field.nuisance.row(row);
        put_affine(z, p, n);
        z.tail<3>() << 1, bend, (later[v] - way.smoothed[v]).dot(way.normals[v]);
    }
    to_unit_rms(field.nuisance);
    states_.push_back(std::move(state));
}

void WaveCopy::look(const Copy& copy, const FootSearch& feet, State state)
{
    const Surface& original = feet.surface();
    WaveBody now = body_;
    for_each_index(body_.topology.sites, [&](int v) { now.points[v] = in_radii(body_, original.points[v]); });
    const Points vertex_normals = site_normals(now);
    const std::vector<std::vector<double>> flows = flows_of(now, vertex_normals, graph_, state.rounds);
    const Samples samples = samples_of(copy.surface, state.registration);
    const std::vector<Offset> offsets = offsets_of(samples, feet, vertex_normals, body_);

    const auto kept =
        std::count_if(offsets.begin(), offsets.end(), [](const Offset& one) { return one.foot.face >= 0; });
    ResidualField& field = state.field;
    field.floor = floor_of_noise * body_.diagonal / body_.radius;
    field.residual.resize(kept);
    field.nuisance.resize(kept, 13 + static_cast<Eigen::Index>(flows.size()));
    Eigen::Index row = 0;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        const Foot& foot = offsets[i].foot;
        if (foot.face < 0)
            continue;
        const Triangle& t = original.triangles[foot.face];
        const Point p = in_radii(body_, foot.point);
        const Point n = outward(body_, feet.normals()[foot.face]);
        field.residual[row] = offsets[i].distance;
        field.places.push_back(p);
        field.kind.push_back(samples.kind[i]);
        field.roughness.push_back(std::abs(at_foot(flows[0], t, foot.weights)) * samples.areas[i]);
        auto z = field.nuisance.row(row++);
        put_affine(z, p, n);
        z[12] = 1;
        for (std::size_t f = 0; f < flows.size(); ++f)
            z[13 + static_cast<Eigen::Index>(f)] = at_foot(flows[f], t, foot.weights);
        state.feet.push_back(foot);
        state.normals.push_back(n);
    }
    to_unit_rms(field.nuisance);
    states_.push_back(std::move(state));
}

Rows WaveCopy::waves(const State& state, const WaveField& field, const WavePlan& plan) const
{
    const int count = plan.count();
    const int rows = state.field.count();
    const std::vector<Triangle>& triangles = body_.topology.triangles;
    Rows result(rows, count);
    if (state.rounds == 0 && field.fine()) {
        const std::vector<double> values = wave_values(state.field.places, plan.vectors, plan.phases);
        result = Eigen::Map<const Rows>(values.data(), rows, count);
        for_each_index(rows, [&](int i) {
            const Foot& foot = state.feet[i];
            result.row(i) *= at_foot(directions_, triangles[foot.face], foot.weights).dot(state.normals[i]);
        });
        return result;
    }
    constexpr int together = 8;
    using Moves = Eigen::Matrix<double, 3, together>; // of a vertex, by so many waves
    for (int first = 0; first < count; first += together) {
        const int some = std::min(together, count - first);
        std::vector<std::vector<double>> wave(some);
        for_chunks(some, 1, [&](int k, int) { wave[k] = field.wave(first + k); });
        std::vector<Moves> moves(wave[0].size(), Moves::Zero());
        for_each_index(static_cast<int>(moves.size()), [&](int v) {
            for (int k = 0; k < some; ++k)
                moves[v].col(k) = wave[k][v] * directions_[v];
        });
        if (!state.places.empty()) {
            std::vector<Moves> there(state.places.size(), Moves::Zero());
            for_each_index(static_cast<int>(there.size()), [&](int v) {
                if (const Foot& foot = state.places[v]; foot.face >= 0)
                    there[v] = at_foot(moves, triangles[foot.face], foot.weights);
            });
            there = umbrella_steps(copy_graph_, std::move(there), 0.5, state.rounds);
            for_each_index(rows, [&](int i) {
                result.row(i).segment(first, some) =
                    (state.normals[i].transpose() * there[state.vertices[i]]).head(some);
            });
            continue;
        }
        moves = umbrella_steps(graph_, std::move(moves), 0.5, state.rounds);
        for_each_index(rows, [&](int i) {
            const Moves at = at_foot(moves, triangles[state.feet[i].face], state.feet[i].weights);
            result.row(i).segment(first, some) = (state.normals[i].transpose() * at).head(some);
        });
    }
    return result;
}

} // namespace vcg_ext
