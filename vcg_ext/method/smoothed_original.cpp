// SPDX-License-Identifier: GPL-3.0-or-later
#include "smoothed_original.h"

#include "../base/parallel.h"
#include "../base/trimmed_mean.h"
#include "../geometry/umbrella.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace vcg_ext {

namespace {

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

/// Whether a copy lies nearer to what a few rounds of smoothing make of the original, to first order: a look that needs
/// no search of its own. Its distances without the farthest twentieth, those left over those as they are.
bool seems_smoothed(const Copy& copy, const Registration& registration, const Points& later)
{
    constexpr double reach = 0.1; // of feet, in sizes
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

/// The number of rounds with the least residual: up a ladder as long as it falls, then by halving.
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

} // namespace

SmoothedOriginal smoothed_original(const Copy& copy, const WaveBody& body, const EdgeGraph& graph)
{
    const Surface& original = copy.registrar.original().surface();
    Smoothing smoothed(body, graph);
    if (!seems_smoothed(copy, copy.registration, in_mesh(body, original, smoothed(3)).points))
        return {};
    std::map<int, SmoothedOriginal> trials;
    const auto residual = [&](int rounds) {
        const auto found = trials.find(rounds);
        if (found != trials.end())
            return found->second.registration.residual;
        SmoothedOriginal trial{rounds, copy.registration, nullptr};
        if (rounds > 0)
            trial.feet = std::make_unique<FootSearch>(in_mesh(body, original, smoothed(rounds)));
        const FootSearch& feet = rounds > 0 ? *trial.feet : copy.registrar.original();
        Registrar(feet, copy.registrar).follow(copy.surface, trial.registration);
        return (trials[rounds] = std::move(trial)).registration.residual;
    };
    const int rounds = best_rounds(residual);
    if (rounds == 0)
        return {};
    SmoothedOriginal best = std::move(trials[rounds]);
    Registrar(*best.feet, copy.registrar).refine(copy.surface, best.registration);
    return best;
}

} // namespace vcg_ext
