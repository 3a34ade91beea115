// SPDX-License-Identifier: GPL-3.0-or-later
#include "front.h"

#include "../base/parallel.h"
#include "fold_guard.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace vcg_ext {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// What a move along the cover's planes costs, as a part of what distance from them costs.
constexpr double along_surface = 0.01;

/// Inverse of the metric in which moves of a vertex are to be short.
Eigen::Matrix3d inverse_metric(const Cover& cover, int v)
{
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
    return metric.inverse();
}

/// The move of unit arrival that is shortest in the metric A: A^-1 g / (g^T A^-1 g).
Point cheapest_direction(const Eigen::Matrix3d& inverse_metric, const Point& gradient)
{
    const Point d = inverse_metric * gradient;
    return d / gradient.dot(d);
}

/// The numbers from 0 on by their times, the lower of equal ones first.
std::vector<int> by_time(const std::vector<double>& times)
{
    const int count = static_cast<int>(times.size());
    const int buckets = 1 + count / 256;
    const double most = ordered_maximum(count, 0.0, [&](int i) { return std::isinf(times[i]) ? 0 : times[i]; });
    const auto bucket = [&](int i) {
        const double place = most > 0 ? times[i] / most * buckets : 0;
        return static_cast<int>(std::clamp(place, 0.0, buckets - 1.0));
    };
    std::vector<int> first(buckets + 1, 0);
    for (int i = 0; i < count; ++i)
        ++first[bucket(i) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::pair<double, int>> sorted(count);
    std::vector<int> next(first.begin(), first.end() - 1);
    for (int i = 0; i < count; ++i)
        sorted[next[bucket(i)]++] = {times[i], i};
    std::vector<int> order(count);
    for_chunks(buckets, 16, [&](int begin, int end) {
        for (int b = begin; b < end; ++b)
            std::sort(sorted.begin() + first[b], sorted.begin() + first[b + 1]);
        for (int i = first[begin]; i < first[end]; ++i)
            order[i] = sorted[i].second;
    });
    return order;
}

class Front {
public:
    Front(const Cover& cover, const std::vector<Arrival>& arrivals, const std::vector<double>& targets,
          double tolerance)
        : cover_(cover), arrivals_(arrivals), targets_(targets),
          tolerance_(tolerance), now_{cover.points, cover.triangles}, moves_(targets.size(), 0),
          missed_(targets.size(), 0)
    {
        const int vertices = static_cast<int>(targets.size());
        std::vector<double> when(vertices);
        for_each_index(vertices, [&](int v) { when[v] = movable(v) ? targets[v] : arrivals[v].distance; });
        order_ = by_time(when);
    }

    void predict_and_correct()
    {
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

    void predict()
    {
        Points move(targets_.size(), Point::Zero());
        for_each_index(static_cast<int>(move.size()), [&](int v) {
            const double way = movable(v) ? targets_[v] - arrivals_[v].distance : 0;
            if (std::abs(way) <= tolerance_)
                return;
            move[v] = way * cheapest_direction(inverse_metric(cover_, v), arrivals_[v].gradient);
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
        for (const int v : order_)
            visit(v, place);
    }

    template <class Place>
    void visit(int v, const Place& place)
    {
        if (!movable(v)) {
            known_[v] = arrivals_[v].distance;
            return;
        }
        const Candidate best = place(v);
        now_.points[v] = best.position;
        known_[v] = best.arrival.distance;
        missed_[v] = best.miss > tolerance_;
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
        std::optional<Eigen::Matrix3d> inverse; // few need it
        Candidate best = iterate(v, predicted, 20, [&](const Candidate& here) -> Point {
            if (!inverse)
                inverse = inverse_metric(cover_, v);
            const Point& g = here.arrival.gradient;
            const double way = targets_[v] - here.arrival.distance + g.dot(here.position - old);
            return old + way * cheapest_direction(*inverse, g);
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
    std::vector<int> order_; ///< in which the front passes the vertices
};

} // namespace

std::vector<double> front_mobility(const Cover& cover, const std::vector<Arrival>& arrivals)
{
    std::vector<double> mobility(arrivals.size());
    for_each_index(static_cast<int>(mobility.size()), [&](int v) {
        const Point& g = arrivals[v].gradient;
        const double along = along_surface * g.dot(inverse_metric(cover, v) * g);
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
