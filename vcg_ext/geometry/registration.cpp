// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration.h"

#include "../base/trimmed_mean.h"
#include "edge_graph.h"
#include "feature_poses.h"
#include "icp.h"
#include "size.h"
#include "umbrella.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

namespace vcg_ext {

namespace {

// Lengths are in sizes of the original.
constexpr double far = 0.08;      ///< further from the original than this is all alike
constexpr double sure = 0.02;     ///< mean of min(distance, far) / far below which no other pose is looked at
constexpr double accepted = 0.25; ///< and below which a pose may be taken
constexpr double least_overlap = 0.97;
constexpr double least_extent = 0.1; ///< what is posed smaller than this lies near the original anywhere
constexpr int samples_to_score = 300;
constexpr int samples_to_polish = 600;
constexpr int samples_to_judge = 1500;
constexpr int samples_to_refine = 4000;
constexpr int poses_to_polish = 6;
constexpr int most_alternatives = 2;

struct Hypothesis {
    const char* by;
    Eigen::Affine3d pose;
};

struct Scored {
    double score = 9;   ///< see `sure`
    double overlap = 0; ///< of the samples
    const char* by = "";
    Eigen::Affine3d pose = Eigen::Affine3d::Identity();

    [[nodiscard]] bool fits() const { return score < accepted && overlap > least_overlap; }
};

/// Diagonal of the box around the first of these points, where the pose puts them.
double extent_of(const Points& points, int count, const Eigen::Affine3d& pose)
{
    Eigen::AlignedBox3d box;
    for (int i = 0; i < count; ++i)
        box.extend(pose * points[i]);
    return box.diagonal().norm();
}

Scored scored(const FootSearch& original, double size, const Points& points, int count, const Hypothesis& hypothesis)
{
    if (extent_of(points, count, hypothesis.pose) < least_extent * size)
        return {1, 0, hypothesis.by, hypothesis.pose};
    Scored result{0, 0, hypothesis.by, hypothesis.pose};
    for (const Foot& foot : feet_of(original, points, count, hypothesis.pose, far * size)) {
        result.score += (foot.face < 0 ? 1 : foot.distance / (far * size)) / count;
        result.overlap += foot.face < 0 ? 0 : 1.0 / count;
    }
    return result;
}

/// `from` laid on `to` in all eight ways, mirrored ones last.
void add_poses(const char* by, const Stand& from, const Stand& to, std::vector<Hypothesis>& all)
{
    if (!(from.length > 0) || !(to.length > 0))
        return;
    for (const double hand : {1.0, -1.0})
        for (const double x : {1.0, -1.0})
            for (const double y : {1.0, -1.0}) {
                Eigen::Affine3d pose;
                pose.linear() = to.axes * Point(x, y, hand * x * y).asDiagonal() * from.axes.transpose() *
                                (to.length / from.length);
                pose.translation() = to.centre - pose.linear() * from.centre;
                all.push_back({by, pose});
            }
}

IcpOptions coarse(double size)
{
    return {12, false, 0.15 * size, 0.02 * size, 0.3};
}

/// Whether two poses hold a body in different ways.
bool differs(const Eigen::Affine3d& a, const Eigen::Affine3d& b)
{
    const auto unit = [](const Eigen::Affine3d& pose) {
        return Eigen::Matrix3d(pose.linear() / std::cbrt(std::abs(pose.linear().determinant())));
    };
    return (unit(a) - unit(b)).cwiseAbs().maxCoeff() > 0.3;
}

/// Whether the first of these fits.
bool fits(const std::vector<Scored>& found)
{
    return !found.empty() && found.front().fits();
}

/// The hypotheses that fit best after some polishing; the best first.
std::vector<Scored> polished(const FootSearch& original, double size, const SurfaceSamples& samples,
                             const std::vector<Hypothesis>& hypotheses)
{
    std::vector<Scored> rough;
    for (const Hypothesis& hypothesis : hypotheses)
        rough.push_back(scored(original, size, samples.points, samples_to_score, hypothesis));
    const auto better = [](const Scored& a, const Scored& b) { return a.score < b.score; };
    std::stable_sort(rough.begin(), rough.end(), better);
    std::vector<Scored> fine;
    for (std::size_t i = 0; i < rough.size() && i < poses_to_polish; ++i) {
        Eigen::Affine3d pose = rough[i].pose;
        if (!refine_pose(original, samples, samples_to_polish, coarse(size), pose))
            continue;
        fine.push_back(scored(original, size, samples.points, samples_to_judge, {rough[i].by, pose}));
        if (fine.back().score < sure)
            break;
    }
    std::stable_sort(fine.begin(), fine.end(), better);
    return fine;
}

/// The scales at which features are looked for: where vertices were kept, the ratio of edges is the scale; else steps
/// from the least, at which a part of the original is as large as it.
std::vector<double> scales_to_try(const Likeness& original, const Surface& surface)
{
    constexpr int steps = 13;
    constexpr double step = 1.1;
    const double least = std::max(0.95 * bounding_diagonal(surface) / original.diagonal,
                                  0.97 * std::sqrt(surface_area(surface)) / original.surface.length);
    std::vector<double> scales;
    const double edges = original.edge > 0 ? mean_edge_length(surface) / original.edge : 0;
    if (edges > least * 0.9 && edges < least * std::pow(step, steps))
        scales.push_back(edges);
    for (int i = 0; i < steps; ++i)
        scales.push_back(least * std::pow(step, i));
    return scales;
}

/// By local shapes.
std::vector<Scored> by_features(const FootSearch& original, const Likeness& likeness, const Surface& surface,
                                const SurfaceSamples& samples, const Progress& progress)
{
    const double diagonal = likeness.diagonal;
    const std::vector<double> scales = scales_to_try(likeness, surface);
    std::vector<double> sizes;
    for (const double scale : scales)
        sizes.push_back(scale * diagonal);
    report(progress, 0, "Comparing shapes");
    const Features own = likeness.features ? *likeness.features : own_features(original.surface());
    const Features other = features_to_match(surface, sizes);
    const NearnessGrid near(original, 0.05 * diagonal);
    const Points few(samples.points.begin(), samples.points.begin() + 150);
    std::vector<Scored> best;
    for (std::size_t s = 0; s < scales.size(); ++s) {
        report(progress, 10 + 90 * static_cast<int>(s) / static_cast<int>(scales.size()), "Comparing shapes");
        FeatureOptions options;
        options.least_side = 0.12 * diagonal;
        options.draw = s;
        std::vector<Hypothesis> hypotheses;
        for (const FeaturePose& found : poses_by_features(own, other, s, scales[s], near, few, options))
            if (found.nearness > 0.35)
                hypotheses.push_back({"features", found.pose});
        for (const Scored& one : polished(original, likeness.size(), samples, hypotheses))
            if (best.empty() || one.score < best.front().score)
                best = {one};
        if (!best.empty() && best.front().fits())
            break;
    }
    return best;
}

/// How far samples lie from the original: mean distance, the farthest twentieth left out.
double spread_of(const FootSearch& original, const SurfaceSamples& samples, const Eigen::Affine3d& pose, double reach)
{
    const int count = static_cast<int>(samples.points.size());
    std::vector<double> distances;
    for (const Foot& foot : feet_of(original, samples.points, count, pose, reach))
        distances.push_back(foot.face < 0 ? reach : foot.distance);
    return trimmed_mean(std::move(distances));
}

/// Whether a stretched pose is still the same pose: where little is left of a copy, twelve unknowns may let it collapse.
bool is_near(const Eigen::Affine3d& affine, const Eigen::Affine3d& pose)
{
    constexpr double most = 1.35;
    const Eigen::Matrix3d change = affine.linear() * pose.linear().inverse();
    const Eigen::Vector3d sizes = Eigen::JacobiSVD<Eigen::Matrix3d>(change).singularValues();
    return sizes[0] < most && sizes[2] * most > 1;
}

/// A pose that fits but for some places, where twelve unknowns make it fit: no similarity lays a stretched copy on all
/// of its original.
Scored stretched(const FootSearch& original, double size, const SurfaceSamples& samples, const Scored& found)
{
    constexpr double less = 0.9; // overlap
    if (found.fits() || found.score >= 2 * accepted || found.overlap < less)
        return found;
    IcpOptions options = coarse(size);
    options.affine = true;
    Eigen::Affine3d pose = found.pose;
    if (!refine_pose(original, samples, samples_to_judge, options, pose) || !is_near(pose, found.pose))
        return found;
    const Scored other = scored(original, size, samples.points, samples_to_judge, {found.by, pose});
    return other.fits() ? other : found;
}

/// On the original after some rounds of smoothing: of the first number of them on which the best one fits, or none.
std::vector<Scored> polished_on_smoothed(const FootSearch& original, double size, const SurfaceSamples& samples,
                                         const std::vector<Hypothesis>& hypotheses, const Progress& progress)
{
    const EdgeGraph graph = edge_graph(original.surface());
    Surface smoothed = original.surface();
    int rounds = 0;
    for (const int wanted : {10, 50}) {
        report(progress, 20 + wanted / 5, "Registering");
        smoothed.points = umbrella_steps(graph, std::move(smoothed.points), 0.5, wanted - rounds);
        rounds = wanted;
        std::vector<Scored> found = polished(FootSearch(smoothed), size, samples, hypotheses);
        if (fits(found))
            return found;
    }
    return {};
}

/// Poses in the order that Registrar says, until one fits; the best first. \param by_scales see Registrar
std::vector<Scored> best_poses(const FootSearch& original, const Likeness& likeness, double size, bool by_scales,
                               const Surface& surface, const SurfaceSamples& samples, const Progress& progress)
{
    report(progress, 0, "Registering");
    std::vector<Hypothesis> hypotheses{{"identity", Eigen::Affine3d::Identity()}};
    std::vector<Scored> found = polished(original, size, samples, hypotheses);
    if (found.empty() || !(found.front().score < sure)) {
        add_poses("volume", solid_stand(surface), likeness.solid, hypotheses);
        add_poses("surface", surface_stand(surface), likeness.surface, hypotheses);
        report(progress, 10, "Registering");
        found = polished(original, size, samples, hypotheses);
    }
    if (!by_scales && !fits(found))
        if (std::vector<Scored> other = polished_on_smoothed(original, size, samples, hypotheses, progress);
            !other.empty())
            found = std::move(other);
    if (!fits(found)) {
        std::vector<Scored> other = by_features(original, likeness, surface, samples, within(progress, 35, 90));
        if (!other.empty() && (found.empty() || other.front().score < found.front().score))
            found = std::move(other);
    }
    return found;
}

/// The best pose, and others that fit about as well and hold the body in another way, as of symmetric bodies.
std::vector<Scored> rivals_of(const std::vector<Scored>& found)
{
    const double close = 2 * found.front().score + 0.03;
    std::vector<Scored> rivals{found.front()};
    for (const Scored& one : found)
        if (one.score < close && static_cast<int>(rivals.size()) <= most_alternatives &&
            std::all_of(rivals.begin(), rivals.end(),
                        [&](const Scored& rival) { return differs(rival.pose, one.pose); }))
            rivals.push_back(one);
    return rivals;
}

} // namespace

double Registration::scale() const
{
    return 1 / std::cbrt(std::abs(pose.linear().determinant()));
}

Registrar::Registrar(const FootSearch& original)
    : original_(original), likeness_(likeness_of(original.surface())), size_(likeness_.size())
{
}

Registrar::Registrar(const FootSearch& scales, const Impression& impression)
    : original_(scales), impression_(&impression), likeness_(impression.likeness), size_(likeness_.size())
{
}

void Registrar::refine(const Surface& surface, Registration& registration) const
{
    const SurfaceSamples samples = sample_surface(surface, samples_to_refine, "registration");
    IcpOptions options{15, false, 0.06 * size_, 0.02 * size_, 0.2};
    refine_pose(original_, samples, samples_to_refine, options, registration.pose);
    registration.affine = registration.pose;
    options.affine = true;
    options.iterations = 20;
    Eigen::Affine3d affine = registration.pose;
    refine_pose(original_, samples, samples_to_refine, options, affine);
    if (is_near(affine, registration.pose))
        registration.affine = affine;
    const double spread = spread_of(original_, samples, registration.affine, far * size_);
    registration.residual = spread / likeness_.diagonal;
    registration.stretched_less =
        spread_of(original_, samples, registration.pose, far * size_) / std::max(spread, 1e-300);
    const std::vector<Foot> feet =
        feet_of(original_, samples.points, samples_to_judge, registration.affine, far * size_);
    registration.inside_out = side_of(original_, samples, feet, registration.affine) < 0;
}

void Registrar::follow(const Surface& surface, Registration& registration) const
{
    const SurfaceSamples samples = sample_surface(surface, samples_to_judge, "following");
    const IcpOptions options{8, true, 0.06 * size_, 0.03 * size_, 0.2};
    Eigen::Affine3d affine = registration.affine;
    refine_pose(original_, samples, samples_to_judge, options, affine);
    if (is_near(affine, registration.pose))
        registration.affine = affine;
    registration.residual = spread_of(original_, samples, registration.affine, far * size_) / likeness_.diagonal;
}

Registration Registrar::operator()(const Surface& surface, const Progress& progress) const
{
    const SurfaceSamples samples = sample_surface(surface, samples_to_refine, "registration");
    std::vector<Scored> found =
        best_poses(original_, likeness_, size_, impression_ != nullptr, surface, samples, progress);
    Registration result;
    if (found.empty())
        return result;
    found.front() = stretched(original_, size_, samples, found.front());
    if (!found.front().fits()) {
        result.pose = result.affine = found.front().pose;
        result.by = found.front().by;
        result.overlap = found.front().overlap;
        result.residual = spread_of(original_, samples, result.pose, far * size_) / likeness_.diagonal;
        return result;
    }

    report(progress, 90, "Registering");
    const std::vector<Scored> rivals = rivals_of(found);
    for (const Scored& rival : rivals) {
        Registration one;
        one.pose = rival.pose;
        one.by = rival.by;
        one.found = true;
        one.overlap = rival.overlap;
        refine(surface, one);
        if (&rival == &rivals.front() || one.residual < result.residual)
            result = one;
    }
    if (impression_)
        settle(surface, result);
    return result;
}

/// The other way round, from the original's points to the surface: scales lie off where the original is curved.
void Registrar::settle(const Surface& surface, Registration& registration) const
{
    const FootSearch feet(surface);
    const int count = static_cast<int>(impression_->points.size());
    const SurfaceSamples samples{{}, impression_->points, impression_->normals};
    const double size = size_ * registration.scale();
    IcpOptions options{15, false, 0.06 * size, 0.02 * size, 0.2};
    const auto refined = [&](const Eigen::Affine3d& pose) {
        Eigen::Affine3d back = pose.inverse();
        refine_pose(feet, samples, count, options, back);
        return Eigen::Affine3d(back.inverse());
    };
    registration.pose = refined(registration.pose);
    options.affine = true;
    options.iterations = 20;
    const Eigen::Affine3d affine = refined(registration.pose);
    registration.affine = is_near(affine, registration.pose) ? affine : registration.pose;

    const auto spread = [&](const Eigen::Affine3d& pose) {
        std::vector<double> distances;
        for (const Foot& foot : feet_of(feet, samples.points, count, pose.inverse(), far * size))
            if (foot.face >= 0 && !foot.on_rim)
                distances.push_back(foot.distance / registration.scale());
        return trimmed_mean(std::move(distances));
    };
    registration.residual = spread(registration.affine) / likeness_.diagonal;
    registration.stretched_less =
        spread(registration.pose) / std::max(registration.residual * likeness_.diagonal, 1e-300);
}

} // namespace vcg_ext
