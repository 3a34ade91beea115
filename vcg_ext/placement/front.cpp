// SPDX-License-Identifier: GPL-3.0-or-later
#include "front.h"

#include "../base/parallel.h"
#include "fold_guard.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace vcg_ext {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// What a move along the cover's planes costs, as a part of what distance from them costs.
constexpr double along_surface = 0.01;

/// Inverse of the metric in which moves are to be short.
std::vector<Eigen::Matrix3d> inverse_metrics(const Cover& cover)
{
    std::vector<Eigen::Matrix3d> inverse(cover.points.size());
    for_each_index(static_cast<int>(inverse.size()), [&](int v) {
        Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
        double area = 0;
        for (const int* f = cover.around.begin(v); f != cover.around.end(v); ++f) {
            const Point& n = cover.normals[*f];
            const double weight = cover.areas[*f];
            normals += weight * n * n.transpose();
            area += weight;
        }
        Eigen::Matrix3d metric = along_surface * Eigen::Matrix3d::Identity();
        if (area > 0)
            metric += (1 - along_surface) / area * normals;
        inverse[v] = metric.inverse();
    });
    return inverse;
}

class Front {
public:
    Front(const Cover& cover, const std::vector<Arrival>& arrivals, const std::vector<double>& targets,
          double tolerance)
        : cover_(cover), arrivals_(arrivals), targets_(targets),
          tolerance_(tolerance), now_{cover.points, cover.triangles}, moves_(targets.size(), 0),
          missed_(targets.size(), 0)
    {
        order_.resize(targets.size());
        std::iota(order_.begin(), order_.end(), 0);
        const auto when = [&](int v) { return movable(v) ? targets[v] : arrivals[v].distance; };
        std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) { return when(a) < when(b); });
    }

    void predict_and_correct()
    {
        inverse_metric_ = inverse_metrics(cover_);
        predict();
        constexpr int passes = 2; // the second profits from room that later vertices made
        for (int pass = 0; pass < passes; ++pass)
            in_order([&](int v) { return correct(v); });
    }

    void one_after_the_other()
    {
        in_order([&](int v) { return follow_gradient(v, cover_.points[v], 50); });
    }

    [[nodiscard]] FrontPlacement result() const
    {
        FrontPlacement placement{now_.points, {}};
        for (std::size_t v = 0; v < moves_.size(); ++v) {
            if (missed_[v])
                ++placement.counts.unconverged;
            else if (moves_[v] > 0)
                ++placement.counts.moves[std::min(moves_[v], 4) - 1];
        }
        return placement;
    }

private:
    /// A place for a vertex, and how far the front's arrival there is from the target.
    struct Candidate {
        Point position;
        Arrival arrival;
        double miss = never;
    };

    [[nodiscard]] bool movable(int v) const { return !std::isnan(targets_[v]); }

    [[nodiscard]] Candidate candidate(int v, const Point& position) const
    {
        const Arrival when = arrival(now_, cover_.around, known_, v, position);
        return {position, when, std::abs(targets_[v] - when.distance)};
    }

    [[nodiscard]] bool folds(int v, const Point& position) const
    {
        return folds_around(cover_, now_.points, v, position);
    }

    /// The move of unit arrival that is shortest in the vertex' metric: A^-1 g / (g^T A^-1 g).
    [[nodiscard]] Point cheapest_direction(int v, const Point& gradient) const
    {
        const Point d = inverse_metric_[v] * gradient;
        return d / gradient.dot(d);
    }

    void predict()
    {
        Points move(targets_.size(), Point::Zero());
        for_each_index(static_cast<int>(move.size()), [&](int v) {
            const double way = movable(v) ? targets_[v] - arrivals_[v].distance : 0;
            if (std::abs(way) <= tolerance_)
                return;
            move[v] = way * cheapest_direction(v, arrivals_[v].gradient);
            now_.points[v] += move[v];
            moves_[v] = 1;
        });
        guard_folds(cover_, now_.points, 20,
                    [&](int v, int step) -> Point { return cover_.points[v] + std::exp2(-step) * move[v]; });
    }

    /// Visits the vertices as the front passes them; `place` returns the place of a movable one.
    template <class Place>
    void in_order(const Place& place)
    {
        known_.assign(targets_.size(), never);
        for (const int v : order_) {
            if (!movable(v)) {
                known_[v] = arrivals_[v].distance;
                continue;
            }
            const Candidate best = place(v);
            now_.points[v] = best.position;
            known_[v] = best.arrival.distance;
            missed_[v] = best.miss > tolerance_;
        }
    }

    /// Repeats `step` from `start` until the arrival is right. A step that would fold a face is halved.
    /// \return the best place on the way
    template <class Step>
    Candidate iterate(int v, const Point& start, int most, const Step& step)
    {
        Candidate here = candidate(v, start);
        Candidate best = here;
        for (int i = 0; i < most && best.miss > tolerance_ && best.miss < never; ++i) {
            const Point way = step(here) - here.position;
            double part = 1;
            while (folds(v, here.position + part * way)) {
                part /= 2;
                if (part < 1e-3)
                    return best;
            }
            here = candidate(v, here.position + part * way);
            ++moves_[v];
            if (here.miss < best.miss)
                best = here;
        }
        return best;
    }

    Candidate follow_gradient(int v, const Point& start, int most)
    {
        return iterate(v, start, most, [&](const Candidate& here) -> Point {
            return here.position + (targets_[v] - here.arrival.distance) * here.arrival.gradient;
        });
    }

    Candidate correct(int v)
    {
        const Point& old = cover_.points[v];
        const Point predicted = now_.points[v];
        Candidate best = iterate(v, predicted, 20, [&](const Candidate& here) -> Point {
            const Point& g = here.arrival.gradient;
            const double way = targets_[v] - here.arrival.distance + g.dot(here.position - old);
            return old + way * cheapest_direction(v, g);
        });
        for (const Point& start : {predicted, old}) {
            if (best.miss <= tolerance_)
                break;
            if (folds(v, start))
                continue;
            const Candidate other = follow_gradient(v, start, 50);
            if (other.miss < best.miss)
                best = other;
        }
        return best;
    }

    const Cover& cover_;
    const std::vector<Arrival>& arrivals_;
    const std::vector<double>& targets_;
    double tolerance_;
    Surface now_;
    std::vector<double> known_; ///< when the front passed the vertices that it has
    std::vector<int> moves_;
    std::vector<char> missed_;
    std::vector<int> order_;
    std::vector<Eigen::Matrix3d> inverse_metric_;
};

} // namespace

std::vector<double> front_mobility(const Cover& cover, const std::vector<Arrival>& arrivals)
{
    const std::vector<Eigen::Matrix3d> inverse_metric = inverse_metrics(cover);
    std::vector<double> mobility(arrivals.size());
    for_each_index(static_cast<int>(mobility.size()), [&](int v) {
        const Point& g = arrivals[v].gradient;
        const double along = along_surface * g.dot(inverse_metric[v] * g);
        mobility[v] = along > 0 ? std::min(along, 1.0) : 0; // not a number where faces are needles: such a vertex stays
    });
    return mobility;
}

FrontPlacement place_front(const Cover& cover, const std::vector<Arrival>& arrivals, const std::vector<double>& targets,
                           double tolerance, const FrontOptions& options)
{
    Front front(cover, arrivals, targets, tolerance);
    if (options.scheme == FrontScheme::PredictCorrect)
        front.predict_and_correct();
    else
        front.one_after_the_other();
    return front.result();
}

} // namespace vcg_ext
