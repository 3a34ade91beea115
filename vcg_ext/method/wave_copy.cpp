// SPDX-License-Identifier: GPL-3.0-or-later
#include "wave_copy.h"

#include "../base/parallel.h"
#include "../base/trimmed_mean.h"
#include "../carrier/wave_flows.h"
#include "../geometry/boundary.h"
#include "../geometry/normals.h"
#include "../geometry/umbrella.h"
#include "../geometry/wave_values.h"
#include "../key/random.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

namespace vcg_ext {

namespace {

constexpr int most_vertices = 40000; ///< of the copy that are looked at
constexpr int area_samples = 12000;
constexpr int points_of_impression = 3000;
constexpr double reach = 0.1;          ///< of feet, in radii
constexpr double least_cosine = -0.2;  ///< between the normals of copy and original
constexpr double least_flatness = 0.8; ///< cosine between a face's normal and the mean of those around: no sharp edges

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
    std::vector<double> area(surface.points.size(), 0);
    for (const Triangle& t : surface.triangles)
        for (const int v : t)
            area[v] += scaled_normal(surface.points, t).norm();
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

template <class Value>
Value at_foot(const std::vector<Value>& of_sites, const Triangle& t, const Point& weights)
{
    return weights[0] * of_sites[t[0]] + weights[1] * of_sites[t[1]] + weights[2] * of_sites[t[2]];
}

/// The sites of a body as they are in the mesh.
Surface in_mesh(const WaveBody& body, const Surface& like, const Points& canonical_points)
{
    Surface surface{Points(body.topology.sites), like.triangles};
    for_each_index(body.topology.sites, [&](int v) {
        surface.points[v] = body.frame.centre + body.radius * (body.frame.axes * canonical_points[v]);
    });
    return surface;
}

/// The original's sites, canonical, after so many rounds of smoothing by a half; those of earlier calls are kept.
class Smoothing {
public:
    Smoothing(const WaveBody& body, const EdgeGraph& graph) : graph_(graph)
    {
        known_[0].assign(body.points.begin(), body.points.begin() + body.topology.sites);
    }

    const Points& operator()(int rounds)
    {
        const auto before = std::prev(known_.upper_bound(rounds));
        if (before->first == rounds)
            return before->second;
        return known_[rounds] = umbrella_steps(graph_, before->second, 0.5, rounds - before->first);
    }

private:
    const EdgeGraph& graph_;
    std::map<int, Points> known_;
};

/// How well a number of rounds explains a copy.
struct Trial {
    Registration registration;
    std::shared_ptr<const FootSearch> feet;
};

/// Whether a copy lies nearer to what a few rounds of smoothing make of the original, to first order: a look that needs
/// no search of its own. Its distances without the farthest twentieth, those left over those as they are.
bool seems_smoothed(const Copy& copy, const Registration& registration, const Points& later)
{
    constexpr double gain = 0.97;
    constexpr int count = 1500;
    const FootSearch& original = copy.registrar.original();
    const SurfaceSamples samples = sample_surface(copy.surface, count, "smoothing");
    std::vector<double> plain;
    std::vector<double> explained;
    for (const Point& sample : samples.points) {
        const Point p = registration.affine * sample;
        const Foot foot = original(p, reach * copy.registrar.size());
        if (foot.face < 0 || foot.on_rim)
            continue;
        const Point& n = original.normals()[foot.face];
        const Triangle& t = original.surface().triangles[foot.face];
        const double distance = n.dot(p - foot.point);
        plain.push_back(std::abs(distance));
        explained.push_back(std::abs(distance - n.dot(at_foot(later, t, foot.weights) - foot.point)));
    }
    return trimmed_mean(explained) < gain * trimmed_mean(plain);
}

/// The number of rounds that brings the original nearest to the copy: up a ladder as long as it falls, then by halving.
/// Never looks at waves.
template <class Try>
int best_rounds(const Try& residual)
{
    const std::array<int, 7> ladder = {0, 3, 8, 20, 50, 120, 300};
    if (residual(3) > residual(0))
        return 0;
    std::size_t i = 1;
    while (i + 1 < ladder.size() && residual(ladder[i + 1]) < residual(ladder[i]))
        ++i;
    int low = ladder[i - 1];
    int best = ladder[i];
    int high = ladder[std::min(i + 1, ladder.size() - 1)];
    while (high - low > 2) {
        const bool below = best - low > high - best;
        const int middle = below ? (low + best) / 2 : (best + high + 1) / 2;
        if (middle == best || middle == low || middle == high)
            break;
        if (residual(middle) < residual(best)) {
            (below ? high : low) = best;
            best = middle;
        } else {
            (below ? low : high) = middle;
        }
    }
    return best;
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

} // namespace

WaveCopy::WaveCopy(const Copy& copy)
    : body_(wave_body(copy.original)), impression_(impression_of(copy.original, points_of_impression)),
      graph_(edge_graph(copy.registrar.original().surface())), directions_(offset_directions(body_))
{
    const Surface& sewn = copy.registrar.original().surface();
    Smoothing smoothed(body_, graph_);
    std::map<int, Trial> trials;
    const auto residual = [&](int rounds) {
        const auto found = trials.find(rounds);
        if (found != trials.end())
            return found->second.registration.residual;
        Trial trial{copy.registration, nullptr};
        if (rounds > 0)
            trial.feet = std::make_shared<FootSearch>(in_mesh(body_, sewn, smoothed(rounds)));
        const FootSearch& feet = rounds > 0 ? *trial.feet : copy.registrar.original();
        Registrar(feet, copy.registrar).follow(copy.surface, trial.registration);
        return (trials[rounds] = std::move(trial)).registration.residual;
    };
    const bool smooth = seems_smoothed(copy, copy.registration, in_mesh(body_, sewn, smoothed(3)).points);
    const int rounds = smooth ? best_rounds(residual) : 0;
    State plain;
    plain.registration = copy.registration;
    if (rounds == 0) {
        look(copy, copy.registrar.original(), std::move(plain));
        return;
    }
    const bool own_edges = has_own_edges(copy);
    State worn;
    worn.rounds = rounds;
    worn.weight = own_edges ? 0.3 : 0.75;
    worn.registration = trials[rounds].registration;
    Registrar(*trials[rounds].feet, copy.registrar).refine(copy.surface, worn.registration);
    plain.weight = own_edges ? 0.1 : 0.25;
    if (own_edges)
        look_before_smoothing(copy, worn);
    look(copy, *trials[rounds].feet, std::move(worn));
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
    const double outward = body_.frame.measure < 0 ? -1 : 1;
    const int count = static_cast<int>(surface.points.size());
    State state;
    state.rounds = way.rounds;
    state.weight = weight;
    state.places = way.feet;
    std::vector<char> rim(count, 0);
    for (const EdgeUse& edge : boundary(surface))
        rim[edge.low] = rim[edge.high] = 1;
    std::vector<double> area(count, 0);
    for (const Triangle& t : surface.triangles)
        for (const int v : t)
            area[v] += scaled_normal(surface.points, t).norm();
    for (int v = 0; v < count; ++v)
        if (way.feet[v].face >= 0 && !way.feet[v].on_rim && !rim[v] && copy_graph_.degree(v) > 0)
            state.vertices.push_back(v);

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
        const Point n = body_.frame.axes.transpose() * way.normals[v] * outward;
        const Point p = body_.frame.axes.transpose() * (way.smoothed[v] - body_.frame.centre) / body_.radius;
        const double bend = at_foot(curvature, body_.topology.triangles[way.feet[v].face], way.feet[v].weights);
        field.residual[row] = outward * (way.laid[v] - way.smoothed[v]).dot(way.normals[v]) / body_.radius;
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
    const double outward = body_.frame.measure < 0 ? -1 : 1;
    const Surface& original = feet.surface();
    const int sites = body_.topology.sites;
    WaveBody now = body_;
    for_each_index(sites, [&](int v) {
        now.points[v] = body_.frame.axes.transpose() * (original.points[v] - body_.frame.centre) / body_.radius;
    });
    const Points vertex_normal = site_normals(now);
    std::vector<std::vector<double>> flows = processing_flows(now, vertex_normal);
    if (state.rounds > 0) { // some rounds more
        const Points later = umbrella_steps(graph_, Points(now.points.begin(), now.points.begin() + sites), 0.5,
                                            std::max(1, state.rounds / 10));
        std::vector<double> flow(sites);
        for (int v = 0; v < sites; ++v)
            flow[v] = (later[v] - now.points[v]).dot(vertex_normal[v]);
        flows.push_back(std::move(flow));
    }

    const Samples samples = samples_of(copy.surface, state.registration);
    const int count = static_cast<int>(samples.points.size());
    std::vector<Foot> all(count);
    std::vector<double> distance(count);
    std::vector<char> good(count, 0);
    for_chunks(count, 512, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            const Foot foot = feet(samples.points[i], reach * body_.radius);
            if (foot.face < 0 || foot.on_rim)
                continue;
            const Triangle& t = original.triangles[foot.face];
            const Point n = body_.frame.axes.transpose() * feet.normals()[foot.face] * outward;
            const Point mean = at_foot(vertex_normal, t, foot.weights).normalized();
            const Point looks = body_.frame.axes.transpose() * samples.normals[i] * outward;
            if (!(looks.dot(mean) > least_cosine) || !(mean.dot(n) > least_flatness))
                continue;
            const Point way = body_.frame.axes.transpose() * (samples.points[i] - foot.point);
            const bool inside = foot.weights.minCoeff() > 1e-9;
            distance[i] = (way.dot(inside ? n : mean) < 0 ? -1 : 1) * way.norm() / body_.radius;
            all[i] = foot;
            good[i] = 1;
        }
    });

    const int kept = static_cast<int>(std::count(good.begin(), good.end(), 1));
    ResidualField& field = state.field;
    field.floor = floor_of_noise * body_.diagonal / body_.radius;
    field.residual.resize(kept);
    field.nuisance.resize(kept, 13 + static_cast<Eigen::Index>(flows.size()));
    Eigen::Index row = 0;
    for (int i = 0; i < count; ++i) {
        if (!good[i])
            continue;
        const Foot& foot = all[i];
        const Triangle& t = original.triangles[foot.face];
        const Point p = body_.frame.axes.transpose() * (foot.point - body_.frame.centre) / body_.radius;
        const Point n = body_.frame.axes.transpose() * feet.normals()[foot.face] * outward;
        field.residual[row] = distance[i];
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
