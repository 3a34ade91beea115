#include "norms.h"

#include "../base/parallel.h"
#include "../carrier/shells.h"
#include "../placement/fold_guard.h"
#include "../placement/radial.h"
#include "../placement/selective.h"
#include "../placement/sphere.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace vcg_ext {

namespace {

/// Places vertices on their spheres. What a vertex got it keeps in later calls, as long as centre and target are the
/// same.
class Placement {
public:
    Placement(const Cover& cover, const EmbedOptions& options)
        : cover_(cover), options_(options), targets_(cover_.points.size(), NAN), best_(cover_.points),
          iterations_(cover_.points.size(), 0), converged_(cover_.points.size(), 1)
    {
    }

    /// \param targets norms about `centre`; NaN where a vertex stays
    Points place(const Point& centre, const std::vector<double>& targets, EmbedReport& report)
    {
        const std::vector<int> changed = take_up(centre, targets);
        if (options_.method == Method::LM)
            place_by_sweeps(changed);
        else
            place_each(changed, best_, [&](int v) {
                return options_.method == Method::QSP ? place_selective(cover_, v, centre_, targets_[v])
                                                      : radial_point(cover_.points[v], centre_, targets_[v]);
            });
        if (options_.method == Method::LM)
            report.solver = summary();
        Points points = best_;
        report.guarded_vertices = guard(points);
        return points;
    }

private:
    /// The vertices that have a target and are not where it asks them to be.
    std::vector<int> take_up(const Point& centre, const std::vector<double>& targets)
    {
        const bool keep = centre == centre_ && (options_.method != Method::LM || options_.sphere_sweeps == 1);
        std::vector<int> changed;
        for (std::size_t v = 0; v < targets.size(); ++v) {
            if (std::isnan(targets[v]))
                best_[v] = cover_.points[v];
            else if (!keep || targets[v] != targets_[v])
                changed.push_back(static_cast<int>(v));
        }
        centre_ = centre;
        targets_ = targets;
        return changed;
    }

    template <class Place>
    static void place_each(const std::vector<int>& vertices, Points& points, const Place& place)
    {
        for_each_index(static_cast<int>(vertices.size()), [&](int i) { points[vertices[i]] = place(vertices[i]); });
    }

    void place_by_sweeps(const std::vector<int>& vertices)
    {
        const SphereWeights& weights = options_.sphere_weights;
        for (int sweep = 0; sweep < options_.sphere_sweeps; ++sweep) {
            const Points neighbours = sweep == 0 ? Points() : best_;
            place_each(vertices, best_, [&](int v) {
                const Eigen::Matrix3d energy =
                    sweep == 0 ? sphere_energy(cover_, v, weights) : sphere_energy(cover_, neighbours, v, weights);
                const SphereSolution solution = place_on_sphere(cover_.points[v], centre_, targets_[v], energy);
                iterations_[v] = solution.iterations;
                converged_[v] = solution.converged;
                return solution.point;
            });
        }
    }

    [[nodiscard]] SolverSummary summary() const
    {
        SolverSummary result;
        double total = 0;
        int moved = 0;
        for (std::size_t v = 0; v < targets_.size(); ++v)
            if (!std::isnan(targets_[v])) {
                ++moved;
                total += iterations_[v];
                result.max_iterations = std::max(result.max_iterations, iterations_[v]);
                result.not_converged += !converged_[v];
            }
        result.mean_iterations = moved > 0 ? total / moved : 0;
        return result;
    }

    /// Steps back from folds: on the target's own sphere towards Cho's point first, then from there to the old place.
    /// \return how many vertices took a step
    int guard(Points& points) const
    {
        constexpr int on_sphere = 4;
        constexpr int steps = 12;
        const auto retreat = [&](int v, int step) -> Point {
            const Point& old = cover_.points[v];
            const Point cho = radial_point(old, centre_, targets_[v]);
            const double part = static_cast<double>(step) / on_sphere;
            if (step <= on_sphere)
                return radial_point(best_[v] + (cho - best_[v]) * part, centre_, targets_[v]);
            return old + (cho - old) * std::exp2(on_sphere - step);
        };
        const std::vector<int> step = guard_folds(cover_, points, steps, retreat);
        return static_cast<int>(std::count_if(step.begin(), step.end(), [](int s) { return s > 0; }));
    }

    const Cover& cover_;
    EmbedOptions options_;
    Point centre_ = Point::Zero();
    std::vector<double> targets_;
    Points best_; ///< before the guard
    std::vector<int> iterations_;
    std::vector<char> converged_;
};

} // namespace

ScalarMethod norm_method(const Cover& cover, const EmbedOptions& options, double trim, EmbedReport& report)
{
    const Surface& surface = cover.surface;
    const auto frame = std::make_shared<Shells>(shells(surface.points, surface.triangles, trim, options.bits));
    ScalarMethod method;
    method.cover = frame->carriers;
    method.cut = [frame, trim](int count) {
        return cut_range(frame->norms, frame->minimum, frame->maximum, trim, count);
    };
    method.mobility.resize(surface.points.size());
    for_each_index(static_cast<int>(surface.points.size()), [&](int v) {
        method.mobility[v] = frame->norms[v] == frame->minimum || frame->norms[v] == frame->maximum ? 0 : 1;
    });
    method.place = [frame, placement = std::make_shared<Placement>(cover, options), &report](
                       const std::vector<double>& targets) { return placement->place(frame->centre, targets, report); };
    const auto marked = std::make_shared<Shells>();
    method.read = [marked, &surface, trim, bits = options.bits](const Points& stored) {
        *marked = shells(stored, surface.triangles, trim, bits);
        return marked->carriers;
    };
    method.reframe = [&cover, frame, marked, trim, bits = options.bits](const Points&) { // those that it read last
        *frame = *marked;
        return cut_range(norms(cover.points, frame->centre), frame->minimum, frame->maximum, trim, bits);
    };
    return method;
}

} // namespace vcg_ext
