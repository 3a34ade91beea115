// SPDX-License-Identifier: GPL-3.0-or-later
#include "patch_reading.h"

#include "../base/parallel.h"
#include "../carrier/thesis_patches.h"
#include "../carrier/two_means.h"
#include "../geometry/eigenbasis.h"

#include <cmath>
#include <utility>

namespace vcg_ext {

namespace {

constexpr double cutoff = 2;       // the highest 90 % of a mesh's eigenvalues
constexpr double high_share = 0.7; // the same, as the thesis prints it
constexpr double printed_threshold = 2.25;

Points about(const Point& centre, Points points)
{
    for_each_index(static_cast<int>(points.size()), [&](int v) { points[v] -= centre; });
    return points;
}

Points filtered(const EdgeGraph& graph, Points points)
{
    return apply(patch_filter(graph), graph, std::move(points));
}

Points exact_bands(const EdgeGraph& graph, const Points& points, const std::vector<std::vector<int>>& patches)
{
    Points band(points.size(), Point::Zero());
    for_chunks(static_cast<int>(patches.size()), 1, [&](int k, int) {
        const Points rows = exact_high_band(graph, points, patches[k], high_share);
        for (std::size_t i = 0; i < rows.size(); ++i)
            band[patches[k][i]] = rows[i];
    });
    return band;
}

double best_threshold(const std::vector<PatchShape>& shapes, int least_samples = 0)
{
    std::vector<double> ratios;
    ratios.reserve(shapes.size());
    for (const PatchShape& shape : shapes)
        if (shape.samples >= least_samples)
            ratios.push_back(std::log(shape.ratio()));
    return two_means(std::move(ratios));
}

void measure_shapes(PatchReading& reading)
{
    reading.shapes.resize(reading.vertices.size());
    for_chunks(static_cast<int>(reading.vertices.size()), 1,
               [&](int k, int) { reading.shapes[k] = patch_shape(reading.band, reading.vertices[k]); });
}

Point rounded(const Point& point)
{
    return point.cast<float>().cast<double>();
}

} // namespace

double PatchReading::soft(int patch) const
{
    const PatchShape& shape = shapes[patch];
    return (std::log(shape.ratio()) - threshold) * std::sqrt(shape.samples) / 2;
}

HighPass patch_filter(const EdgeGraph& graph)
{
    const double bound = laplacian_bound(graph);
    return high_pass(cutoff, bound, high_pass_degree(bound));
}

Frame patch_frame(const Points& vertices, const SolidTopology& topology)
{
    Frame frame = principal_frame(solid_points(topology, vertices), topology);
    check_frame(frame);
    return frame;
}

PatchReading cut_patches(const Points& points, const SolidTopology& topology, const EdgeGraph& graph, const Plan& plan,
                         const Frame& frame)
{
    const int count = static_cast<int>(plan.order.size());
    PatchReading reading;
    reading.frame = frame;
    reading.patches = plan.options.as_printed ? thesis_patches(points, topology, frame, patch_layers, count, plan.trim)
                                              : equal_area_patches(points, topology, graph, frame, patch_layers,
                                                                   count / patch_layers, plan.trim);
    reading.vertices = patch_vertices(reading.patches);
    return reading;
}

void read_bands(Points points, const EdgeGraph& graph, const Plan& plan, PatchReading& reading)
{
    const bool as_printed = plan.options.as_printed;
    points = about(reading.frame.centre, std::move(points));
    reading.band = as_printed ? exact_bands(graph, points, reading.vertices) : filtered(graph, std::move(points));
    measure_shapes(reading);
    reading.threshold = as_printed ? std::log(printed_threshold) : best_threshold(reading.shapes);
}

void read_given(Points points, const EdgeGraph& graph, PatchReading& reading)
{
    reading.vertices = patch_vertices(reading.patches);
    reading.band = filtered(graph, about(reading.frame.centre, std::move(points)));
    measure_shapes(reading);
    reading.threshold = best_threshold(reading.shapes, vertices_of_a_shape);
}

PatchReading read_patches(const Surface& surface, const Plan& plan, const Frame& frame)
{
    const EdgeGraph graph = edge_graph(surface);
    PatchReading reading = cut_patches(surface.points, solid_topology(surface), graph, plan, frame);
    read_bands(surface.points, graph, plan, reading);
    return reading;
}

std::vector<int> carrying_patches(const PatchReading& reading, const Plan& plan, AxisFlips flips)
{
    // As printed, the number of patches hangs on the mesh: those that it lacks are passed over.
    std::vector<int> patches;
    for (const int patch : plan.order)
        if (patch < reading.patches.count())
            patches.push_back(reading.patches.flipped(patch, flips));
    patches.resize(plan.order.size(), -1);
    return patches;
}

void read_moves(const HighPass& filter, const EdgeGraph& graph, const Moves& moves, const Points& points,
                PatchReading& reading)
{
    std::vector<int> moved;
    Points steps;
    for (std::size_t i = 0; i < moves.vertices.size(); ++i) {
        const int v = moves.vertices[i];
        const Point step = rounded(points[v]) - rounded(moves.before[i]);
        if (step.isZero(0))
            continue;
        moved.push_back(v);
        steps.push_back(step);
    }
    add_band_of_moves(filter, graph, moved, steps, reading.band);
    measure_shapes(reading);
}

} // namespace vcg_ext
