// SPDX-License-Identifier: GPL-3.0-or-later
#include "fast_marching.h"

#include <cmath>
#include <limits>
#include <queue>

namespace vcg_ext {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// A vertex that the front has reached.
struct Reached {
    Point position;
    double distance;
};

/// The triangle ABC laid into a plane: A at the origin, B at (c, 0), C at (p, q) with q >= 0. Its axes in space are
/// `along` and `across`.
struct Flat {
    double c, p, q;
    Point along, across;

    Flat(const Point& a, const Point& b, const Point& at)
    {
        const Point ab = b - a;
        const Point ac = at - a;
        c = ab.norm();
        along = ab / c;
        p = ac.dot(along);
        across = ac - p * along;
        q = across.norm();
        if (q > 0)
            across /= q;
    }

    [[nodiscard]] Point in_space(double x, double y) const { return x * along + y * across; }
};

void pass_edge(const Reached& a, const Point& at, Arrival& best)
{
    const Point step = at - a.position;
    const double length = step.norm();
    if (a.distance + length < best.distance)
        best = {a.distance + length, step / length};
}

/// The front passes between A and B to C, as a circle about the point beyond AB that lies `ta` from A and `tb` from B.
void pass_between(const Flat& flat, double ta, double tb, Arrival& best)
{
    const double c = flat.c;
    const double p = flat.p;
    const double q = flat.q;
    if (!(q > 0))
        return;
    const double x = ((ta - tb) * (ta + tb) + c * c) / (2 * c); // the virtual source is (x, -y)
    const double y = std::sqrt(std::max(0.0, ta * ta - x * x));
    const double crossing = x * q + p * y; // times (y + q), where its way to C crosses AB
    if (crossing < 0 || crossing > c * (y + q))
        return;
    const double distance = std::sqrt((p - x) * (p - x) + (q + y) * (q + y));
    const double later = std::max({distance, ta, tb}); // the front never turns back
    if (later < best.distance)
        best = {later, flat.in_space((p - x) / distance, (q + y) / distance)};
}

/// The front passes through one face to C at `at`; A and B are the face's other vertices, at least one of them reached.
void pass_face(const Surface& surface, const std::vector<double>& distance, int a, int b, const Point& at,
               Arrival& best)
{
    const Reached from_a{surface.points[a], distance[a]};
    const Reached from_b{surface.points[b], distance[b]};
    pass_edge(from_a, at, best);
    pass_edge(from_b, at, best);
    if (from_a.distance < never && from_b.distance < never)
        pass_between(Flat(from_a.position, from_b.position, at), from_a.distance, from_b.distance, best);
}

} // namespace

std::vector<Arrival> march(const Surface& surface, const VertexFaces& around, const SurfacePoint& source)
{
    using Entry = std::pair<double, int>;
    const std::size_t vertices = surface.points.size();
    std::vector<Arrival> best(vertices, Arrival{never});
    std::vector<double> distance(vertices, never);
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;

    const auto reach = [&](int v, const auto& update) {
        const double before = best[v].distance;
        update(best[v]);
        if (best[v].distance < before)
            front.emplace(best[v].distance, v);
    };
    for (const int v : surface.triangles[source.face])
        reach(v, [&](Arrival& a) { pass_edge({source.position, 0}, surface.points[v], a); });

    while (!front.empty()) {
        const auto [when, v] = front.top();
        front.pop();
        if (distance[v] < never)
            continue;
        distance[v] = when;
        for (const int* f = around.begin(v); f != around.end(v); ++f) {
            const Triangle& t = surface.triangles[*f];
            const int corner = t[0] == v ? 0 : t[1] == v ? 1 : 2;
            const int others[2] = {t[(corner + 1) % 3], t[(corner + 2) % 3]};
            for (int k = 0; k < 2; ++k)
                if (distance[others[k]] == never)
                    reach(others[k], [&, v = v, when = when](Arrival& a) {
                        const Point& at = surface.points[others[k]];
                        const int third = others[1 - k];
                        pass_edge({surface.points[v], when}, at, a);
                        if (distance[third] < never) // whose edge the front took when it came there
                            pass_between(Flat(surface.points[v], surface.points[third], at), when, distance[third], a);
                    });
        }
    }
    return best;
}

Arrival arrival(const Surface& surface, const VertexFaces& around, const std::vector<double>& distance, int vertex,
                const Point& position)
{
    Arrival best{never};
    for (const int* f = around.begin(vertex); f != around.end(vertex); ++f) {
        const Triangle& t = surface.triangles[*f];
        const int corner = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
        const int a = t[(corner + 1) % 3];
        const int b = t[(corner + 2) % 3];
        if (distance[a] < never || distance[b] < never)
            pass_face(surface, distance, a, b, position, best);
    }
    return best;
}

} // namespace vcg_ext
