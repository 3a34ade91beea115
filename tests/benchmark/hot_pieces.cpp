// SPDX-License-Identifier: GPL-3.0-or-later
// What embedding and detection spend their time in, piece by piece and on all cores: bunny00 subdivided 0, 1 and 2 times
// by Loop's scheme. Built where Google Benchmark is.
//
//   hot_pieces [--benchmark_filter=march ...]     Google Benchmark's own arguments

#include "support/load.h"
#include "vcg_ext/attack/loop.h"
#include "vcg_ext/base/parallel.h"
#include "vcg_ext/base/weld.h"
#include "vcg_ext/carrier/shells.h"
#include "vcg_ext/geometry/chebyshev.h"
#include "vcg_ext/geometry/fast_marching.h"
#include "vcg_ext/geometry/normals.h"
#include "vcg_ext/geometry/rings.h"
#include "vcg_ext/geometry/solid_transform.h"
#include "vcg_ext/geometry/umbrella.h"
#include "vcg_ext/placement/histogram.h"
#include "vcg_ext/placement/sphere.h"

#include <benchmark/benchmark.h>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <utility>

using namespace vcg_ext;

namespace {

constexpr int carriers = 64;

/// As embedding has it: numbered by rings.
const Surface& bunny(int subdivisions)
{
    static std::map<int, Surface> made;
    if (made.find(subdivisions) == made.end()) {
        Body body = body_of(subdivide_by_loop(load("bunny00.off"), subdivisions));
        number_by_rings(body);
        made.emplace(subdivisions, std::move(body.surface));
    }
    return made.at(subdivisions);
}

VertexFaces around_of(const Surface& surface)
{
    return vertex_faces(static_cast<int>(surface.points.size()), surface.triangles);
}

/// What is prepared once, and then called as often as it takes.
using Piece = std::function<void()>;

template <class Work>
Piece repeated(const Work& work)
{
    return [work] { benchmark::DoNotOptimize(work()); };
}

Piece welding(const Surface& surface)
{
    return repeated([&surface] { return weld(surface); });
}

Piece normals(const Surface& surface)
{
    return repeated([&surface] { return vertex_normals(surface.points, surface.triangles); });
}

Piece taubin_passes(const Surface& surface)
{
    return repeated([&surface, graph = edge_graph(surface)] { return taubin(graph, surface.points, 10); });
}

Piece chebyshev_filter(const Surface& surface)
{
    const EdgeGraph graph = edge_graph(surface);
    const double bound = laplacian_bound(graph);
    const HighPass filter = high_pass(bound / 2, bound, high_pass_degree(bound));
    return repeated([&surface, graph, filter] { return apply(filter, graph, surface.points); });
}

Piece fast_marching(const Surface& surface)
{
    const VertexFaces around = around_of(surface);
    const SurfacePoint source{*around.begin(0), surface.points[0]};
    return repeated([&surface, fans = fans_of(around, surface.triangles), source] {
        return distances_from(source, surface.points, surface.triangles, fans);
    });
}

Piece wave_sums(const Surface& surface)
{
    Points waves;
    for (int k = 0; k < carriers; ++k) // directions on a spiral, lengths as plans draw them
        waves.emplace_back((10 + 10.0 * k / carriers) * Point(std::cos(k), std::sin(k), 0.3).normalized());
    const double size = bounding_diagonal(surface) / 4;
    for (Point& wave : waves)
        wave /= size;
    return repeated(
        [&surface, waves, size] { return solid_transform(surface.points, surface.triangles, waves, 20 / size); });
}

/// All histograms of norms, each mean moved by a tenth of its carrier.
Piece histograms(const Surface& surface)
{
    const Carriers cut = shells(surface.points, shell_frame(surface), 0, carriers);
    std::vector<std::vector<double>> values(carriers);
    for (std::size_t v = 0; v < cut.label.size(); ++v)
        if (cut.label[v] >= 0)
            values[cut.label[v]].push_back(cut.value[v]);
    return repeated([values] {
        double last = 0;
        for (const std::vector<double>& carrier : values)
            last = map_histogram(carrier, Statistic::Mean, 0.6, 1e-6).back();
        return last;
    });
}

/// All vertices to spheres a little larger than their own.
Piece sphere_placement(const Surface& surface)
{
    const auto cover = std::make_shared<Cover>(surface);
    const ShellFrame frame = shell_frame(surface);
    const double step = 1e-3 * (frame.maximum - frame.minimum);
    return repeated([cover, frame, step] {
        Points placed(cover->points.size());
        for_each_index(static_cast<int>(placed.size()), [&](int v) {
            const Point& old = cover->points[v];
            const Eigen::Matrix3d energy = sphere_energy(*cover, v, SphereOptions().weights);
            placed[v] = place_on_sphere(old, frame.centre, (old - frame.centre).norm() + step, energy).point;
        });
        return placed;
    });
}

} // namespace

int main(int argc, char** argv)
{
    const std::pair<const char*, Piece (*)(const Surface&)> pieces[] = {
        {"weld", welding},        {"normals", normals}, {"taubin", taubin_passes},  {"chebyshev", chebyshev_filter},
        {"march", fast_marching}, {"waves", wave_sums}, {"histograms", histograms}, {"spheres", sphere_placement},
    };
    for (const auto& [name, prepare] : pieces)
        benchmark::RegisterBenchmark(name,
                                     [prepare = prepare](benchmark::State& state) {
                                         const Surface& surface = bunny(static_cast<int>(state.range(0)));
                                         const Piece piece = prepare(surface);
                                         for (auto _ : state)
                                             piece();
                                         state.counters["vertices/s"] =
                                             benchmark::Counter(static_cast<double>(surface.points.size()),
                                                                benchmark::Counter::kIsIterationInvariantRate);
                                     })
            ->DenseRange(0, 2)
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 1;
    benchmark::RunSpecifiedBenchmarks();
}
