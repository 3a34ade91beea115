// SPDX-License-Identifier: GPL-3.0-or-later
#include "norms.h"

#include "../base/parallel.h"
#include "../base/prefetch.h"
#include "../carrier/comb.h"
#include "../placement/fold_guard.h"
#include "../placement/radial.h"
#include "../placement/selective.h"
#include "copy.h"

#include <cmath>

namespace vcg_ext {

namespace {

/// Places vertices on their spheres. What a vertex got it keeps in later calls, as long as centre and target are the
/// same.
class SpherePlacement {
public:
    SpherePlacement(const Cover& cover, Radial how, const SphereOptions& options)
        : cover_(cover), how_(how), options_(options), targets_(cover_.points.size(), NAN),
          best_(copy_of(cover_.points)), iterations_(cover_.points.size(), 0), converged_(cover_.points.size(), 1)
    {
    }

    /// \param targets norms about `centre`; NaN where a vertex stays
    Proposal place(const Point& centre, const std::vector<double>& targets)
    {
        const std::vector<int> changed = take_up(centre, targets);
        Proposal proposal;
        if (how_ == Radial::Sphere) {
            place_by_sweeps(changed);
            proposal.solver = summary();
        } else {
            place_each(changed, [&](int v) {
                return how_ == Radial::Selective ? place_selective(cover_, v, centre_, targets_[v])
                                                 : radial_point(cover_.points[v], centre_, targets_[v]);
            });
        }
        folded_ = folded_faces(cover_, best_, folded_, changed);
        proposal.points = copy_of(best_);
        proposal.guarded_vertices = guard(proposal.points);
        return proposal;
    }

private:
    /// The vertices that are not where the targets ask them to be.
    std::vector<int> take_up(const Point& centre, const std::vector<double>& targets)
    {
        const bool keep = centre == centre_ && (how_ != Radial::Sphere || options_.sweeps == 1);
        std::vector<int> changed = indices_where(static_cast<int>(targets.size()), [&](int v) {
            return std::isnan(targets[v]) ? !std::isnan(targets_[v]) : !keep || targets[v] != targets_[v];
        });
        centre_ = centre;
        targets_ = targets;
        return changed;
    }

    void prefetch_faces(int v) const
    {
        for (const int* f = cover_.around.begin(v); f != cover_.around.end(v); ++f) {
            prefetch(&cover_.normals[*f]);
            if (how_ == Radial::Selective)
                prefetch(&cover_.triangles[*f]);
        }
    }

    template <class Place>
    void place_each(const std::vector<int>& vertices, const Place& place)
    {
        for_each_index(static_cast<int>(vertices.size()), [&](int i) {
            if (const std::size_t later = i + elements_ahead / 6; later < vertices.size()) // each has some six faces
                prefetch_faces(vertices[later]);
            const int v = vertices[i];
            best_[v] = std::isnan(targets_[v]) ? cover_.points[v] : place(v);
        });
    }

    void place_by_sweeps(const std::vector<int>& vertices)
    {
        for (int sweep = 0; sweep < options_.sweeps; ++sweep) {
            const Points neighbours = sweep == 0 ? Points() : best_;
            place_each(vertices, [&](int v) {
                const Eigen::Matrix3d energy = sweep == 0 ? sphere_energy(cover_, v, options_.weights)
                                                          : sphere_energy(cover_, neighbours, v, options_.weights);
                const SphereSolution solution = place_on_sphere(cover_.points[v], centre_, targets_[v], energy);
                iterations_[v] = solution.iterations;
                converged_[v] = solution.converged;
                return solution.point;
            });
        }
    }

    [[nodiscard]] SolverSummary summary() const
    {
        struct Counts {
            long iterations = 0;
            int moved = 0, most = 0, not_converged = 0;
        };
        const Counts all = ordered_fold(
            static_cast<int>(targets_.size()), Counts(),
            [this](Counts& counts, int v) {
                if (std::isnan(targets_[v]))
                    return;
                ++counts.moved;
                counts.iterations += iterations_[v];
                counts.most = std::max(counts.most, iterations_[v]);
                counts.not_converged += !converged_[v];
            },
            [](Counts& counts, const Counts& part) {
                counts.moved += part.moved;
                counts.iterations += part.iterations;
                counts.most = std::max(counts.most, part.most);
                counts.not_converged += part.not_converged;
            });
        const double mean = all.moved > 0 ? static_cast<double>(all.iterations) / all.moved : 0;
        return {mean, all.most, all.not_converged};
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
        return static_cast<int>(guard_folds(cover_, points, folded_, steps, retreat).vertices.size());
    }

    const Cover& cover_;
    Radial how_;
    SphereOptions options_;
    Point centre_ = Point::Zero();
    std::vector<double> targets_;
    Points best_;             ///< before the guard
    std::vector<int> folded_; ///< faces, there
    std::vector<int> iterations_;
    std::vector<char> converged_;
};

/// The norm as embed_scalar() wants it.
class Norm {
public:
    Norm(const Cover& cover, Radial how, const Plan& plan, const SphereOptions& options)
        : cover_(cover), plan_(plan), holes_(hole_fans(cover.surface)), placement_(cover, how, options)
    {
    }

    static constexpr double guard = 0;

    [[nodiscard]] ShellFrame find(const Points& points) const { return shell_frame(points, cover_.triangles, holes_); }

    [[nodiscard]] Carriers read(const Points& points, const ShellFrame& frame) const
    {
        return shells(points, frame, plan_.trim, plan_.options.bits);
    }

    [[nodiscard]] ShellFrame on_cover(const Points& /*points*/, const ShellFrame& frame) const { return frame; }

    void aim(const ShellFrame& frame)
    {
        frame_ = frame;
        norms_ = norms(cover_.points, frame.centre);
    }

    [[nodiscard]] Carriers cut(int count) const
    {
        return cut_range(norms_, frame_.minimum, frame_.maximum, plan_.trim, count);
    }

    /// The vertices that attain the least and the largest norm stay, or the range would move with them.
    [[nodiscard]] std::vector<double> mobility() const
    {
        const int vertices = static_cast<int>(norms_.size());
        const Range range = range_of(vertices, [this](int v) { return norms_[v]; });
        std::vector<double> result(norms_.size());
        for_each_index(vertices, [&](int v) {
            result[v] = norms_[v] == range.least || norms_[v] == range.most || cover_.holds(v) ? 0 : 1;
        });
        return result;
    }

    Proposal place(const std::vector<double>& targets) { return placement_.place(frame_.centre, targets); }

    /// Whether the cover seems to carry a mark of some key.
    [[nodiscard]] bool looks_marked() const { return find_comb(norms_, frame_.minimum, frame_.maximum).found(); }

private:
    const Cover& cover_;
    const Plan& plan_;
    HoleFans holes_;
    SpherePlacement placement_;
    ShellFrame frame_;
    std::vector<double> norms_; ///< of the cover, in that frame
};

} // namespace

Plan plan_norms(const Key& key, const CarrierOptions& options)
{
    Plan plan;
    plan.options = options;
    plan.trim = options.trim >= 0 ? options.trim
                                  : static_cast<double>(key.stream("epsilon").below(15001)) / 1e5; // thesis 5.2.1
    plan.order = key.stream("carrier-order").permutation(options.bits);
    return plan;
}

MarkFrame find_norms(const Surface& surface, const Plan& /*plan*/)
{
    return shell_frame(surface);
}

Readings read_norms(const Surface& surface, const Plan& plan, const MarkFrame& frame)
{
    return read_carriers(shells(surface.points, std::get<ShellFrame>(frame), plan.trim, plan.options.bits), plan);
}

Readings read_norms_copy(const Copy& copy, const Plan& plan, const MarkFrame& frame)
{
    const auto cut = [&](const Points& points) {
        return shells(points, std::get<ShellFrame>(frame), plan.trim, plan.options.bits);
    };
    return read_part(cut(copy.laid().points), cut(copy.original.points), copy.left(), plan);
}

void certify_norms(const Surface& original, const Plan& plan, Certificate& certificate)
{
    certificate.shells = std::get<ShellFrame>(find_norms(original, plan));
}

Readings read_certified_norms(const CertifiedCopy& copy, const Plan& plan)
{
    return read_norms(laid_on_original(copy.surface, copy.registration), plan, certified(copy.certificate.shells));
}

template <Radial placement>
Marking embed_norms(const Cover& cover, const Plan& plan, const Bits& coded, const PlacementOptions& options,
                    const Progress& progress)
{
    Norm norm(cover, placement, plan, options.sphere);
    Marking marking = embed_scalar(norm, cover, plan, coded, options, progress);
    if (marking.rounds > 0 && norm.looks_marked()) // in no round nothing moved: it is this very mark
        marking.warnings.emplace_back(
            "The mesh seems to carry a mark of this kind already, and this one erases it. Where both are wanted, take "
            "the unmarked mesh and two methods that leave each other alone, as Waves or Spectral do with those of vertex "
            "norms.");
    return marking;
}

template Marking embed_norms<Radial::Sphere>(const Cover&, const Plan&, const Bits&, const PlacementOptions&,
                                             const Progress&);
template Marking embed_norms<Radial::Selective>(const Cover&, const Plan&, const Bits&, const PlacementOptions&,
                                                const Progress&);
template Marking embed_norms<Radial::Straight>(const Cover&, const Plan&, const Bits&, const PlacementOptions&,
                                               const Progress&);

} // namespace vcg_ext
