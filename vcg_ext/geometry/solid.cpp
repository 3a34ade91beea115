// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid.h"

#include "../base/parallel.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numeric>
#include <unordered_map>

namespace vcg_ext {

namespace {

constexpr double pi = 3.14159265358979323846;

/// An edge between two vertices, and how often faces run along it.
struct EdgeUse {
    int low = 0;
    int high = 0;
    int balance = 0; ///< from `low` to `high` more often than back
    int faces = 0;
};

/// All edges for which `wanted(use)` holds, by their lower vertex.
template <class Wanted>
std::vector<EdgeUse> edges_where(int vertices, const std::vector<Triangle>& triangles, const Wanted& wanted)
{
    constexpr int chunk = 4096;
    const VertexFaces around = vertex_faces(vertices, triangles);
    std::vector<std::vector<EdgeUse>> found((vertices + chunk - 1) / chunk);
    for_chunks(vertices, chunk, [&](int begin, int end) {
        std::vector<EdgeUse> uses;
        for (int v = begin; v < end; ++v) {
            uses.clear();
            const auto use = [&](int other, int way) {
                if (other <= v)
                    return;
                for (EdgeUse& e : uses)
                    if (e.high == other) {
                        e.balance += way;
                        ++e.faces;
                        return;
                    }
                uses.push_back({v, other, way, 1});
            };
            for (const int* f = around.begin(v); f != around.end(v); ++f) {
                const Triangle& t = triangles[*f];
                const int corner = t[0] == v ? 0 : t[1] == v ? 1 : 2;
                use(t[(corner + 1) % 3], 1);
                use(t[(corner + 2) % 3], -1);
            }
            for (const EdgeUse& e : uses)
                if (wanted(e))
                    found[begin / chunk].push_back(e);
        }
    });
    std::vector<EdgeUse> all;
    for (const auto& part : found)
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

std::vector<EdgeUse> boundary(int vertices, const std::vector<Triangle>& triangles)
{
    return edges_where(vertices, triangles, [](const EdgeUse& e) { return e.balance != 0; });
}

/// Disjoint sets of numbers.
class Sets {
public:
    explicit Sets(int count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

    int of(int i)
    {
        while (parent_[i] != i)
            i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    /// The lower number names the set, so the order of joining does not matter.
    void join(int a, int b)
    {
        a = of(a);
        b = of(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<int> parent_;
};

/// Turns the faces of each component (joined at edges of two faces) the way that most of its area runs.
void orient_alike(const Points& points, std::vector<Triangle>& triangles)
{
    const int faces = static_cast<int>(triangles.size());
    const int vertices = static_cast<int>(points.size());
    const std::vector<EdgeUse> pairs = edges_where(vertices, triangles, [](const EdgeUse& e) { return e.faces == 2; });
    const VertexFaces around = vertex_faces(vertices, triangles);
    std::vector<std::vector<std::pair<int, bool>>> next(faces); // face, and whether it runs the other way round
    for (const EdgeUse& e : pairs) {
        int at[2] = {0, 0};
        int count = 0;
        for (const int* f = around.begin(e.low); f != around.end(e.low) && count < 2; ++f)
            if (const Triangle& t = triangles[*f]; t[0] == e.high || t[1] == e.high || t[2] == e.high)
                at[count++] = *f;
        next[at[0]].emplace_back(at[1], e.balance != 0);
        next[at[1]].emplace_back(at[0], e.balance != 0);
    }
    std::vector<signed char> way(faces, 0);
    std::vector<int> component;
    for (int start = 0; start < faces; ++start) {
        if (way[start])
            continue;
        component.assign(1, start);
        way[start] = 1;
        double balance = 0;
        for (std::size_t i = 0; i < component.size(); ++i) {
            const int f = component[i];
            balance += way[f] * scaled_normal(points, triangles[f]).norm();
            for (const auto& [other, turned] : next[f])
                if (!way[other]) {
                    way[other] = static_cast<signed char>(turned ? -way[f] : way[f]);
                    component.push_back(other);
                }
        }
        for (const int f : component)
            if (way[f] * balance < 0)
                std::swap(triangles[f][1], triangles[f][2]);
    }
}

/// Per vertex the number of its site, where vertices of `edges` lie together; empty where none do.
std::vector<int> sew(const Points& points, const std::vector<EdgeUse>& edges, double diagonal, int& sites)
{
    sites = static_cast<int>(points.size());
    if (edges.empty())
        return {};
    std::vector<double> lengths;
    std::vector<int> rim;
    for (const EdgeUse& e : edges) {
        lengths.push_back((points[e.high] - points[e.low]).norm());
        rim.insert(rim.end(), {e.low, e.high});
    }
    std::sort(rim.begin(), rim.end());
    rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
    std::nth_element(lengths.begin(), lengths.begin() + lengths.size() / 2, lengths.end());
    // Sewing must not eat the boundary's own edges.
    const double near = std::min(1e-5 * diagonal, lengths[lengths.size() / 2] / 4);
    if (!(near * 1e15 > diagonal))
        return {}; // nothing lies together that doubles can tell apart
    const auto cell = [](std::int64_t x, std::int64_t y, std::int64_t z) {
        return static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15U ^
               static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4FU ^
               static_cast<std::uint64_t>(z) * 0x165667B19E3779F9U;
    };
    std::unordered_map<std::uint64_t, std::vector<int>> heads; // first vertices of their sites, by cell
    std::vector<int> head(points.size());
    std::iota(head.begin(), head.end(), 0);
    bool any = false;
    for (const int v : rim) {
        const Eigen::Array3d at = ((points[v] - points[rim.front()]) / near).array().floor();
        const std::int64_t x = static_cast<std::int64_t>(at[0]);
        const std::int64_t y = static_cast<std::int64_t>(at[1]);
        const std::int64_t z = static_cast<std::int64_t>(at[2]);
        double best = near;
        for (int step = 0; step < 27; ++step) {
            const auto found = heads.find(cell(x + step % 3 - 1, y + step / 3 % 3 - 1, z + step / 9 - 1));
            if (found == heads.end())
                continue;
            for (const int w : found->second)
                if (const double d = (points[w] - points[v]).norm(); d < best) {
                    best = d;
                    head[v] = w;
                }
        }
        if (head[v] == v)
            heads[cell(x, y, z)].push_back(v);
        else
            any = true;
    }
    if (!any)
        return {};
    std::vector<int> site(points.size(), -1);
    sites = 0;
    for (std::size_t v = 0; v < points.size(); ++v)
        site[v] = head[v] == static_cast<int>(v) ? sites++ : site[head[v]];
    return site;
}

/// Moments of a solid about a point up to the third degree, not divided by the volume.
struct Moments {
    double volume = 0;
    Point first = Point::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    std::array<Eigen::Matrix3d, 3> third{Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()};

    Moments& operator+=(const Moments& other)
    {
        volume += other.volume;
        first += other.first;
        second += other.second;
        for (int i = 0; i < 3; ++i)
            third[i] += other.third[i];
        return *this;
    }
};

/// Takes up the tetrahedron over the origin: integrals of products of linear functions over a simplex.
void take(Moments& m, const Eigen::Matrix3d& p)
{
    const double v = p.col(0).dot(p.col(1).cross(p.col(2))) / 6;
    const Point sum = p.rowwise().sum();
    const Eigen::Matrix3d pp = p * p.transpose();
    m.volume += v;
    m.first += v / 4 * sum;
    m.second += v / 20 * (pp + sum * sum.transpose());
    // Polarised h_3 = (s^3 + 3 s p2 + 2 p3) / 6 over 20.
    for (int i = 0; i < 3; ++i) {
        Eigen::Matrix3d cubes = Eigen::Matrix3d::Zero();
        for (int corner = 0; corner < 3; ++corner)
            cubes += p(i, corner) * (p.col(corner) * p.col(corner).transpose());
        m.third[i] += v / 120 *
                      (sum[i] * (sum * sum.transpose()) + sum[i] * pp + sum * pp.row(i) + pp.col(i) * sum.transpose() +
                       2 * cubes);
    }
}

} // namespace

SolidTopology solid_topology(const Surface& surface)
{
    SolidTopology result;
    result.triangles = surface.triangles;
    int vertices = static_cast<int>(surface.points.size());
    result.sites = vertices;
    std::vector<EdgeUse> edges = boundary(vertices, result.triangles);
    if (!edges.empty()) {
        result.site_of_vertex = sew(surface.points, edges, bounding_diagonal(surface), result.sites);
        const Points points = solid_points(result, surface.points);
        if (!result.site_of_vertex.empty()) {
            std::vector<Triangle> sewn;
            for (const Triangle& t : surface.triangles) {
                const Triangle s{result.site_of_vertex[t[0]], result.site_of_vertex[t[1]], result.site_of_vertex[t[2]]};
                if (s[0] != s[1] && s[1] != s[2] && s[2] != s[0])
                    sewn.push_back(s);
            }
            result.triangles = std::move(sewn);
            edges = boundary(result.sites, result.triangles);
        }
        const auto against = [](const EdgeUse& e) { return e.faces == 2; };
        if (std::any_of(edges.begin(), edges.end(), against)) {
            orient_alike(points, result.triangles);
            edges = boundary(result.sites, result.triangles);
        }
    }
    result.surface_triangles = static_cast<int>(result.triangles.size());

    Sets pieces(result.sites);
    for (const EdgeUse& e : edges)
        pieces.join(e.low, e.high);
    std::vector<int> apex_of(edges.empty() ? 0 : result.sites, -1);
    for (const EdgeUse& e : edges) {
        int& apex = apex_of[pieces.of(e.low)];
        if (apex < 0)
            apex = result.sites + result.apexes++;
        for (int i = 0; i < std::abs(e.balance); ++i) {
            const int from = e.balance > 0 ? e.low : e.high;
            const int to = e.balance > 0 ? e.high : e.low;
            result.rims.push_back({from, to, apex});
            result.triangles.push_back({to, from, apex});
        }
    }
    return result;
}

Surface sewn_surface(const SolidTopology& topology, const Points& vertices)
{
    Surface surface{solid_points(topology, vertices), topology.triangles};
    surface.points.resize(topology.sites);
    surface.triangles.resize(topology.surface_triangles);
    return surface;
}

Points solid_points(const SolidTopology& topology, const Points& vertices)
{
    Points points;
    if (topology.site_of_vertex.empty()) {
        points = vertices;
    } else {
        points.assign(topology.sites, Point::Zero());
        std::vector<int> count(topology.sites, 0);
        for (std::size_t v = 0; v < vertices.size(); ++v) {
            points[topology.site_of_vertex[v]] += vertices[v];
            ++count[topology.site_of_vertex[v]];
        }
        for (int s = 0; s < topology.sites; ++s)
            points[s] /= count[s];
    }
    points.resize(topology.points(), Point::Zero());
    place_apexes(topology, points);
    return points;
}

void place_apexes(const SolidTopology& topology, Points& points)
{
    std::fill(points.begin() + topology.sites, points.end(), Point::Zero());
    std::vector<double> length(topology.apexes, 0);
    for (const auto& [from, to, apex] : topology.rims) {
        const double l = (points[to] - points[from]).norm();
        points[apex] += l * (points[to] + points[from]) / 2;
        length[apex - topology.sites] += l;
    }
    for (int a = 0; a < topology.apexes; ++a)
        if (length[a] > 0)
            points[topology.sites + a] /= length[a];
}

Frame solid_frame(const Points& points, const std::vector<Triangle>& triangles)
{
    const int count = static_cast<int>(triangles.size());
    Eigen::AlignedBox3d box;
    for (const Triangle& t : triangles)
        for (const int v : t)
            box.extend(points[v]);
    if (box.isEmpty())
        return {};
    const Point near = box.center(); // moments about a point far away cancel badly
    const Moments m = ordered_fold(
        count, Moments{},
        [&](Moments& sum, int f) {
            Eigen::Matrix3d p;
            for (int k = 0; k < 3; ++k)
                p.col(k) = points[triangles[f][k]] - near;
            take(sum, p);
        },
        [](Moments& sum, const Moments& part) { sum += part; });
    if (!(std::abs(m.volume) > 1e-9 * std::pow(box.diagonal().norm(), 3)))
        return {};
    Frame frame;
    frame.from_volume = true;
    frame.measure = m.volume;
    const Point c = m.first / m.volume;
    frame.centre = near + c;
    const Eigen::Matrix3d second = m.second / m.volume;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(second - c * c.transpose());
    frame.variances = solver.eigenvalues().reverse();
    if (!(frame.variances[2] > 0))
        return {};
    frame.axes = solver.eigenvectors().rowwise().reverse();
    if (frame.axes.determinant() < 0)
        frame.axes.col(2) *= -1;
    for (int axis = 0; axis < 3; ++axis) {
        const Point u = frame.axes.col(axis);
        double raw = 0;
        for (int i = 0; i < 3; ++i)
            raw += u[i] * u.dot(m.third[i] * u) / m.volume;
        const double mean = u.dot(c);
        frame.third_moments[axis] = raw - 3 * mean * u.dot(second * u) + 2 * mean * mean * mean;
    }
    for (int axis = 0; axis < 2; ++axis)
        if (frame.third_moments[axis] < 0) {
            frame.axes.col(axis) *= -1;
            frame.axes.col(2) *= -1;
            frame.third_moments[axis] *= -1;
            frame.third_moments[2] *= -1;
        }
    return frame;
}

void align_axes(Frame& frame, const Eigen::Matrix3d& like)
{
    // The axis that is the most sure takes its place first.
    const Frame old = frame;
    Eigen::Matrix3d overlap = like.transpose() * old.axes;
    for (int round = 0; round < 3; ++round) {
        int to = 0;
        int from = 0;
        overlap.cwiseAbs().maxCoeff(&to, &from);
        const double sign = overlap(to, from) < 0 ? -1 : 1;
        frame.axes.col(to) = sign * old.axes.col(from);
        frame.third_moments[to] = sign * old.third_moments[from];
        frame.variances[to] = old.variances[from];
        overlap.row(to).setZero();
        overlap.col(from).setZero();
    }
}

double ball_radius(const Frame& frame)
{
    return std::cbrt(3 * std::abs(frame.measure) / (4 * pi));
}

std::array<double, 2> angular_moment(const Points& points, const std::vector<Triangle>& triangles, const Frame& frame,
                                     int first, int second, int n)
{
    using Complex = std::complex<double>;
    const double r = ball_radius(frame);
    const Point u = frame.axes.col(first) / r;
    const Point v = frame.axes.col(second) / r;
    const Complex sum = ordered_sum(static_cast<int>(triangles.size()), Complex(0), [&](int f) {
        Complex h[17] = {1}; // complete homogeneous polynomials of the corners so far; the fourth corner is 0
        Eigen::Matrix3d p;
        for (int corner = 0; corner < 3; ++corner) {
            p.col(corner) = points[triangles[f][corner]] - frame.centre;
            const Complex z(u.dot(p.col(corner)), v.dot(p.col(corner)));
            for (int k = 1; k <= n; ++k)
                h[k] += z * h[k - 1];
        }
        return p.col(0).dot(p.col(1).cross(p.col(2))) / 6 * h[n];
    });
    const double binomial = (n + 1.0) * (n + 2.0) * (n + 3.0) / 6;
    const Complex mean = sum / (binomial * frame.measure);
    return {mean.real(), mean.imag()};
}

} // namespace vcg_ext
