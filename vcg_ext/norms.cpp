#include "norms.h"

#include "carrier/shells.h"
#include "parallel.h"
#include "placement/fold_guard.h"
#include "placement/selective.h"
#include "placement/sphere.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace vcg_ext {

namespace {

struct Task {
    const Cover& cover;
    Point centre;
    const std::vector<double>& targets;
    std::vector<int> movable; ///< the vertices that have a target
};

template <class Place>
Points place_each(const Task& task, const Place& place)
{
    Points points = task.cover.points;
    for_each_index(static_cast<int>(task.movable.size()), [&](int i) {
        const int v = task.movable[i];
        points[v] = place(i, v, task.targets[v]);
    });
    return points;
}

Points place_sphere(const Task& task, const EmbedOptions& options, SolverSummary& summary)
{
    std::vector<int> iterations(task.movable.size(), 0);
    std::vector<char> converged(task.movable.size(), 1);
    Points current = task.cover.points;
    for (int sweep = 0; sweep < options.sphere_sweeps; ++sweep)
        current = place_each(task, [&](int i, int v, double norm) {
            const Eigen::Matrix3d energy = sphere_energy(task.cover, current, v, options.sphere_weights);
            const SphereSolution solution = place_on_sphere(task.cover.points[v], task.centre, norm, energy);
            iterations[i] = solution.iterations;
            converged[i] = solution.converged;
            return solution.point;
        });
    double total = 0;
    for (const int n : iterations)
        total += n;
    summary.mean_iterations = iterations.empty() ? 0 : total / static_cast<double>(iterations.size());
    summary.max_iterations = iterations.empty() ? 0 : *std::max_element(iterations.begin(), iterations.end());
    summary.not_converged = static_cast<int>(std::count(converged.begin(), converged.end(), 0));
    return current;
}

Points place_best(const Task& task, const EmbedOptions& options, EmbedReport& report)
{
    if (options.method == Method::LM)
        return place_sphere(task, options, report.solver.emplace());
    if (options.method == Method::QSP)
        return place_each(task,
                          [&](int, int v, double norm) { return place_selective(task.cover, v, task.centre, norm); });
    return place_each(task,
                      [&](int, int v, double norm) { return radial_point(task.cover.points[v], task.centre, norm); });
}

/// Steps back from a fold: on the target's own sphere towards Cho's point first, then from there towards the old place.
int guard(const Task& task, Points& points)
{
    constexpr int on_sphere = 4;
    constexpr int steps = 12;
    const Points best = points;
    const auto retreat = [&](int v, int step) -> Point {
        const Point& old = task.cover.points[v];
        const double norm = task.targets[v];
        const Point cho = radial_point(old, task.centre, norm);
        if (step <= on_sphere)
            return radial_point(best[v] + (cho - best[v]) * (static_cast<double>(step) / on_sphere), task.centre, norm);
        return old + (cho - old) * std::exp2(on_sphere - step);
    };
    const std::vector<int> step = guard_folds(task.cover, points, steps, retreat);
    return static_cast<int>(std::count_if(step.begin(), step.end(), [](int s) { return s > 0; }));
}

} // namespace

ScalarMethod norm_method(const Surface& surface, const EmbedOptions& options, double trim, EmbedReport& report)
{
    const auto cover = std::make_shared<const Cover>(surface);
    const auto frame = std::make_shared<Shells>(shells(surface.points, surface.triangles, trim, options.bits));
    ScalarMethod method;
    method.cover = frame->carriers;
    method.cut = [frame, trim](int count) {
        return cut_range(frame->norms, frame->minimum, frame->maximum, trim, count);
    };
    method.fixed.resize(surface.points.size());
    for (std::size_t v = 0; v < surface.points.size(); ++v)
        method.fixed[v] = frame->norms[v] == frame->minimum || frame->norms[v] == frame->maximum;
    method.place = [cover, frame, options, &report](const std::vector<double>& targets) {
        Task task{*cover, frame->centre, targets, {}};
        for (std::size_t v = 0; v < targets.size(); ++v)
            if (!std::isnan(targets[v]))
                task.movable.push_back(static_cast<int>(v));
        Points points = place_best(task, options, report);
        report.guarded_vertices = guard(task, points);
        return points;
    };
    method.read = [&surface, trim, bits = options.bits](const Points& stored) {
        return shells(stored, surface.triangles, trim, bits).carriers;
    };
    method.reframe = [cover, frame, trim, read = method.read, bits = options.bits](const Points& stored) {
        *frame = shells(stored, cover->triangles, trim, bits);
        return cut_range(norms(cover->points, frame->centre), frame->minimum, frame->maximum, trim, bits);
    };
    return method;
}

} // namespace vcg_ext
