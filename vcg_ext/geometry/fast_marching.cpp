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

void take(Arrival& best, double distance, const Point& gradient)
{
    if (distance < best.distance)
        best = {distance, gradient};
}

void pass_edge(const Reached& a, const Point& at, Arrival& best)
{
    const Point step = at - a.position;
    const double length = step.norm();
    if (a.distance + length < best.distance)
        best = {a.distance + length, step / length};
}

/// The front passes between (0, 0), reached at `ta`, and (c, 0), reached at `tb`, to (p, q), which is in `flat`'s own
/// plane.
void pass_between(double c, double ta, double tb, const Flat& flat, double p, double q, Wave wave, Arrival& best)
{
    if (!(q > 0))
        return;
    if (wave == Wave::Circular) {
        const double x = ((ta - tb) * (ta + tb) + c * c) / (2 * c); // the virtual source is (x, -y)
        const double y = std::sqrt(std::max(0.0, ta * ta - x * x));
        const double crossing = x * q + p * y; // times (y + q), where its way to C crosses AB
        if (crossing < 0 || crossing > c * (y + q))
            return;
        const double distance = std::sqrt((p - x) * (p - x) + (q + y) * (q + y));
        const double later = std::max({distance, ta, tb}); // the front never turns back
        if (later < best.distance)
            best = {later, flat.in_space((p - x) / distance, (q + y) / distance)};
    } else {
        const double gx = (tb - ta) / c;
        if (!(std::abs(gx) < 1))
            return;
        const double gy = std::sqrt(1 - gx * gx);
        const double crossing = p * gy - gx * q; // times gy
        if (crossing < 0 || crossing > c * gy)
            return;
        const double later = std::max({ta + gx * p + gy * q, ta, tb});
        take(best, later, flat.in_space(gx, gy));
    }
}

/// The face on the other side of edge AB, and its third vertex; -1 where there is none.
struct Beyond {
    int face = -1;
    int vertex = -1;
};

Beyond beyond(const Surface& surface, const VertexFaces& around, int face, int a, int b)
{
    for (const int* f = around.begin(a); f != around.end(a); ++f) {
        if (*f == face)
            continue;
        const Triangle& t = surface.triangles[*f];
        for (int k = 0; k < 3; ++k)
            if (t[k] == b)
                return {*f, t[0] + t[1] + t[2] - a - b};
    }
    return {};
}

/// Where a vertex comes to lie that is unfolded into ABC's plane: on the side of the edge left-right that C is not on.
Eigen::Vector2d unfolded(const Eigen::Vector2d& left, const Eigen::Vector2d& right, double from_left, double from_right)
{
    const Eigen::Vector2d edge = right - left;
    const double length = edge.norm();
    const double x = ((from_left - from_right) * (from_left + from_right) + length * length) / (2 * length);
    const double y = std::sqrt(std::max(0.0, from_left * from_left - x * x));
    return left + (x * edge + y * Eigen::Vector2d(edge.y(), -edge.x())) / length;
}

/// The two halves of an obtuse angle at C, split by a vertex found through AB; the whole where there is none.
void pass_unfolded(const Surface& surface, const VertexFaces& around, const std::vector<double>& distance, int face,
                   int a, int b, const Flat& flat, Wave wave, Arrival& best)
{
    const Eigen::Vector2d c(flat.p, flat.q);
    // Seen from C the sector in which both halves are acute lies between the normals of CA and CB.
    const Eigen::Vector2d to_a = -c;
    const Eigen::Vector2d to_b = Eigen::Vector2d(flat.c, 0) - c;
    int left = a;
    int right = b;
    Eigen::Vector2d left_at(0, 0);
    Eigen::Vector2d right_at(flat.c, 0);
    for (int steps = 0; steps < 20; ++steps) {
        const Beyond next = beyond(surface, around, face, left, right);
        if (next.face < 0)
            break;
        face = next.face;
        const Point& d = surface.points[next.vertex];
        const Eigen::Vector2d at =
            unfolded(left_at, right_at, (d - surface.points[left]).norm(), (d - surface.points[right]).norm());
        const Eigen::Vector2d to_d = at - c;
        const bool acute_to_a = to_d.dot(to_a) >= 0;
        const bool acute_to_b = to_d.dot(to_b) >= 0;
        if (acute_to_a && acute_to_b) {
            const double td = distance[next.vertex];
            const auto half = [&](const Eigen::Vector2d& p0, double t0, const Eigen::Vector2d& p1, double t1) {
                if (t0 == never || t1 == never)
                    return;
                // The half's own coordinates: p0 at the origin, p1 on the x axis, C above it.
                const Eigen::Vector2d ab = p1 - p0;
                const double length = ab.norm();
                const Eigen::Vector2d x = ab / length;
                const Eigen::Vector2d y(-x.y(), x.x());
                Flat turned = flat;
                turned.along = flat.in_space(x.x(), x.y());
                turned.across = flat.in_space(y.x(), y.y());
                pass_between(length, t0, t1, turned, (c - p0).dot(x), (c - p0).dot(y), wave, best);
            };
            half({0, 0}, distance[a], at, td);
            half(at, td, {flat.c, 0}, distance[b]);
            take(best, td + to_d.norm(), flat.in_space(-to_d.x() / to_d.norm(), -to_d.y() / to_d.norm()));
            return;
        }
        if (acute_to_a) {
            left = next.vertex;
            left_at = at;
        } else {
            right = next.vertex;
            right_at = at;
        }
    }
    if (distance[a] < never && distance[b] < never)
        pass_between(flat.c, distance[a], distance[b], flat, flat.p, flat.q, wave, best);
}

/// The front passes through one face to C at `at`; A and B are the face's other vertices, at least one of them reached.
void pass_face(const Surface& surface, const VertexFaces& around, const std::vector<double>& distance, int face, int a,
               int b, const Point& at, const MarchOptions& options, Arrival& best)
{
    const Reached from_a{surface.points[a], distance[a]};
    const Reached from_b{surface.points[b], distance[b]};
    pass_edge(from_a, at, best);
    pass_edge(from_b, at, best);
    const bool both = from_a.distance < never && from_b.distance < never;
    if (!both && !options.unfold)
        return;
    const Flat flat(from_a.position, from_b.position, at);
    const bool obtuse = flat.p * (flat.p - flat.c) + flat.q * flat.q < 0;
    if (options.unfold && obtuse)
        pass_unfolded(surface, around, distance, face, a, b, flat, options.wave, best);
    else if (both)
        pass_between(flat.c, from_a.distance, from_b.distance, flat, flat.p, flat.q, options.wave, best);
}

} // namespace

std::vector<Arrival> march(const Surface& surface, const VertexFaces& around, const SurfacePoint& source,
                           const MarchOptions& options)
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
                    reach(others[k], [&, v = v](Arrival& a) {
                        pass_face(surface, around, distance, *f, v, others[1 - k], surface.points[others[k]], options,
                                  a);
                    });
        }
    }
    return best;
}

Arrival arrival(const Surface& surface, const VertexFaces& around, const std::vector<double>& distance, int vertex,
                const Point& position, const MarchOptions& options)
{
    Arrival best{never};
    for (const int* f = around.begin(vertex); f != around.end(vertex); ++f) {
        const Triangle& t = surface.triangles[*f];
        const int corner = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
        const int a = t[(corner + 1) % 3];
        const int b = t[(corner + 2) % 3];
        if (distance[a] < never || distance[b] < never)
            pass_face(surface, around, distance, *f, a, b, position, options, best);
    }
    return best;
}

} // namespace vcg_ext
