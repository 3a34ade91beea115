// SPDX-License-Identifier: GPL-3.0-or-later
#include "fast_marching.h"

#include "../base/parallel.h"
#include "front_queue.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vcg_ext {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// A vertex, and when the front reaches it.
struct alignas(32) Reached {
    Point position;
    double distance;
};

/// `best`, or when the front comes along the edge from `a` if that is earlier.
double along_edge(const Reached& a, const Point& at, double best)
{
    const double square = (at - a.position).squaredNorm();
    const double left = best - a.distance;
    return left > 0 && left * left > square ? std::min(best, a.distance + std::sqrt(square)) : best;
}

/// The front passes between A and B to C, as a circle about the point S beyond AB that lies T(A) from A and T(B) from
/// B. All in the plane of ABC, with A at the origin; lengths along AB and away from it are times |AB|, which saves
/// roots.
struct Passage {
    Point ab, ac;
    double square;         ///< |AB|^2
    double along, off;     ///< of C
    double s_along, s_off; ///< of S, which lies on the other side

    Passage(const Reached& a, const Reached& b, const Point& c) : ab(b.position - a.position), ac(c - a.position)
    {
        square = ab.squaredNorm();
        along = ab.dot(ac);
        off = std::sqrt(ab.cross(ac).squaredNorm());
        s_along = ((a.distance - b.distance) * (a.distance + b.distance) + square) / 2;
        s_off = std::sqrt(std::max(0.0, a.distance * a.distance * square - s_along * s_along));
    }

    /// Whether the way from S to C crosses AB.
    [[nodiscard]] bool is_open() const
    {
        const double crossing = s_along * off + along * s_off;
        return off > 0 && crossing >= 0 && crossing <= square * (off + s_off);
    }

    [[nodiscard]] double distance(const Reached& a, const Reached& b) const
    {
        const double between =
            ac.squaredNorm() + a.distance * a.distance + 2 * (off * s_off - along * s_along) / square;
        return std::max({a.distance, b.distance, std::sqrt(std::max(0.0, between))}); // the front never turns back
    }

    /// From S to C.
    [[nodiscard]] Point direction() const
    {
        const double stretch = 1 + s_off / off;
        return (stretch * ac + ((1 - stretch) * along - s_along) / square * ab).normalized();
    }
};

/// `best`, or when the front comes from between `a` and `b` if that is earlier.
double through_face(const Reached& a, const Reached& b, const Point& at, double best)
{
    const Passage passage(a, b, at);
    return passage.is_open() ? std::min(best, passage.distance(a, b)) : best;
}

class March {
public:
    March(const Points& points, const Fans& fans)
        : fans_(fans), reached_(points.size()), front_(bucket_width(points, fans))
    {
        for_each_index(static_cast<int>(points.size()), [&](int v) { reached_[v] = {points[v], never}; });
    }

    void start(const SurfacePoint& source, const Triangle& face)
    {
        for (const int v : face)
            reach(v, along_edge({source.position, 0}, reached_[v].position, never));
    }

    void run()
    {
        FrontQueue::Entry next;
        while (front_.pop(next))
            if (const auto [when, v] = next; when == reached_[v].distance) // else it was reached earlier
                pass(v);
    }

    [[nodiscard]] std::vector<double> distances() const
    {
        std::vector<double> result(reached_.size());
        for_each_index(static_cast<int>(result.size()), [&](int v) { result[v] = reached_[v].distance; });
        return result;
    }

private:
    /// Of the front's buckets, such that each holds some ten entries: a front that is as long as the surface is wide has
    /// the root of the number of vertices, over an edge.
    static double bucket_width(const Points& points, const Fans& fans)
    {
        constexpr int samples = 1000;
        const int step = std::max(1, fans.vertices() / samples);
        double length = 0;
        int edges = 0;
        for (int v = 0; v < fans.vertices(); v += step)
            if (fans.begin(v) != fans.end(v)) {
                length += (points[*fans.begin(v)] - points[v]).norm();
                ++edges;
            }
        return length > 0 ? 8 * length / edges / std::sqrt(fans.vertices()) : 1;
    }

    void reach(int v, double when)
    {
        if (when >= reached_[v].distance)
            return;
        reached_[v].distance = when;
        front_.push(when, v);
    }

    /// The front comes to `v`, and from there, and from between it and those that it reached before, to the others
    /// around.
    void pass(int v)
    {
        const Reached here = reached_[v];
        int last = Fans::gap;
        bool waits = false; // the last: for the front
        double when = never;
        for (const int *w = fans_.begin(v), *end = fans_.end(v); w != end; ++w) {
            const bool last_was_passed = last != Fans::gap && !waits;
            const bool before_waits = waits;
            double when_here = never;
            waits = *w != Fans::gap && reached_[*w].distance > here.distance;
            if (waits) {
                const Reached& there = reached_[*w];
                when_here = along_edge(here, there.position, there.distance);
                if (last_was_passed)
                    when_here = through_face(here, reached_[last], there.position, when_here);
            } else if (before_waits && *w != Fans::gap) {
                when = through_face(here, reached_[*w], reached_[last].position, when);
            }
            if (before_waits)
                reach(last, when);
            last = *w;
            when = when_here;
        }
        if (waits)
            reach(last, when);
    }

    const Fans& fans_;
    std::vector<Reached> reached_;
    FrontQueue front_;
};

/// How the front comes to C at `at`, over the faces around vertex C.
/// \param known `known(w)`: when it reaches another vertex; `never` where it has not been yet
/// \param best  an arrival that is known already
template <class Known>
Arrival arrival_by(const Surface& surface, const VertexFaces& around, const Known& known, int vertex, const Point& at,
                   Arrival best = {never})
{
    for (const int* f = around.begin(vertex); f != around.end(vertex); ++f) {
        const Triangle& t = surface.triangles[*f];
        const int corner = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
        const int other[2] = {t[(corner + 1) % 3], t[(corner + 2) % 3]};
        const Reached a{surface.points[other[0]], known(other[0])};
        const Reached b{surface.points[other[1]], known(other[1])};
        for (const Reached* from : {&a, &b})
            if (const double when = along_edge(*from, at, best.distance); when < best.distance)
                best = {when, (at - from->position).normalized()};
        if (a.distance == never || b.distance == never)
            continue;
        const Passage passage(a, b, at);
        if (!passage.is_open())
            continue;
        if (const double when = passage.distance(a, b); when < best.distance)
            best = {when, passage.direction()};
    }
    return best;
}

} // namespace

std::vector<double> distances_from(const SurfacePoint& source, const Points& points,
                                   const std::vector<Triangle>& triangles, const Fans& fans)
{
    March march(points, fans);
    march.start(source, triangles[source.face]);
    march.run();
    return march.distances();
}

std::vector<Arrival> arrivals_of(const std::vector<double>& distances, const SurfacePoint& source,
                                 const Surface& surface, const VertexFaces& around)
{
    const Triangle& first = surface.triangles[source.face];
    std::vector<Arrival> result(distances.size(), Arrival{never});
    for_each_index(static_cast<int>(result.size()), [&](int v) {
        if (distances[v] == never)
            return;
        Arrival best{never};
        const Point& at = surface.points[v];
        if (std::find(first.begin(), first.end(), v) != first.end())
            best = {(at - source.position).norm(), (at - source.position).normalized()};
        const auto known = [&](int w) { return distances[w] <= distances[v] ? distances[w] : never; };
        result[v] = {distances[v], arrival_by(surface, around, known, v, at, best).gradient};
    });
    return result;
}

Arrival arrival(const Surface& surface, const VertexFaces& around, const std::vector<double>& distance, int vertex,
                const Point& position)
{
    return arrival_by(
        surface, around, [&](int w) { return distance[w]; }, vertex, position);
}

} // namespace vcg_ext
