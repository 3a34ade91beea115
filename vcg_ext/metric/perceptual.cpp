// SPDX-License-Identifier: GPL-3.0-or-later
#include "perceptual.h"

#include "../base/mesh.h"
#include "../base/parallel.h"
#include "../geometry/closest.h"
#include "../geometry/edge_graph.h"

#include <algorithm>
#include <cmath>
#include <vcg/complex/algorithms/update/curvature.h>

namespace vcg_ext {

namespace {

/// vcglib walks along borders, and where more than two faces share an edge it never arrives. So such
/// edges become borders.
void cut_at_non_manifold_edges(Mesh& mesh)
{
    std::vector<std::pair<Face*, int>> cut;
    for (Face& face : mesh.face)
        for (int edge = 0; edge < 3; ++edge)
            if (!vcg::face::IsManifold(face, edge))
                cut.emplace_back(&face, edge);
    for (const auto& [face, edge] : cut) {
        face->FFp(edge) = face;
        face->FFi(edge) = static_cast<char>(edge);
    }
}

/// Curvatures of two meshes over one window, and what MSDM wants to know of them.
class Window {
public:
    void clear() { *this = Window(); }
    void add(double x, double y)
    {
        ++count_;
        x_ += x;
        y_ += y;
        xx_ += x * x;
        yy_ += y * y;
        xy_ += x * y;
    }
    /// \param c what curvature is too small to see
    [[nodiscard]] double cubed_distance(double c) const
    {
        const double n = count_;
        const double mx = x_ / n;
        const double my = y_ / n;
        const double vx = std::max(0.0, xx_ / n - mx * mx);
        const double vy = std::max(0.0, yy_ / n - my * my);
        const double covariance = vx > 0 && vy > 0 ? xy_ / n - mx * my : 0;
        const double sx = std::sqrt(vx);
        const double sy = std::sqrt(vy);
        const double both = std::sqrt(vx * vy); // not sx * sy: of equal curvatures it is their covariance exactly
        const double luminance = std::abs(mx - my) / (std::max(mx, my) + c);
        const double contrast = std::abs(sx - sy) / (std::max(sx, sy) + c);
        const double structure = std::abs(both - covariance) / (both + c * c);
        const auto cube = [](double v) { return v * v * v; };
        return 0.4 * cube(luminance) + 0.4 * cube(contrast) + 0.2 * cube(structure);
    }

private:
    int count_ = 0;
    double x_ = 0, y_ = 0, xx_ = 0, yy_ = 0, xy_ = 0;
};

/// Visits what lies within `radius` of vertex after vertex, along the edges.
class Windows {
public:
    Windows(const Surface& surface, double radius) : surface_(surface), graph_(edge_graph(surface)), radius_(radius) {}

    /// Calls `visit(a, b, t)` for the places a + t (b - a) between two vertices.
    template <class Visit>
    void operator()(int centre, std::vector<int>& queue, std::vector<int>& seen, const Visit& visit) const
    {
        const Point& o = surface_.points[centre];
        queue.assign(1, centre);
        seen[centre] = centre;
        for (std::size_t next = 0; next < queue.size(); ++next) {
            const int v = queue[next];
            visit(v, v, 0.0);
            for (const int* other = graph_.begin(v); other != graph_.end(v); ++other) {
                if (seen[*other] == centre)
                    continue;
                if ((surface_.points[*other] - o).norm() <= radius_) {
                    seen[*other] = centre;
                    queue.push_back(*other);
                } else
                    visit(v, *other, leaves(surface_.points[v] - o, surface_.points[*other] - o));
            }
        }
    }

private:
    /// The part of the way from `a`, inside, to `b`, outside, at which the sphere is met: |a + t (b - a)| = radius.
    [[nodiscard]] double leaves(const Point& a, const Point& b) const
    {
        const Point way = b - a;
        const double half = a.dot(way);
        const double length = way.squaredNorm();
        return (std::sqrt(std::max(0.0, half * half + length * (radius_ * radius_ - a.squaredNorm()))) - half) / length;
    }

    const Surface& surface_;
    EdgeGraph graph_;
    double radius_;
};

constexpr const char* phase = "Structural distance";
constexpr int enough_windows = 1 << 19;

/// Mean of the cubed local distances, over windows of `surface`; `x` and `y` are the two curvatures of its vertices.
/// Windows of fine meshes hold more vertices and overlap the more, so evenly chosen ones will do.
double mean_cubed_distance(const Surface& surface, const std::vector<double>& x, const std::vector<double>& y,
                           double radius, double c, const Progress& progress)
{
    const int vertices = static_cast<int>(surface.points.size());
    const Windows windows(surface, radius);
    const int stride = std::max(1, vertices / enough_windows);
    const int count = (vertices + stride - 1) / stride;
    constexpr int chunk = 16384;
    std::vector<double> sums(chunk_count(count, chunk));
    for_chunks(count, chunk, progress, phase, [&](int begin, int end) {
        std::vector<int> queue;
        std::vector<int> seen(vertices, -1);
        Window window;
        for (int i = begin; i < end; ++i) {
            window.clear();
            windows(i * stride, queue, seen,
                    [&](int a, int b, double t) { window.add(x[a] + t * (x[b] - x[a]), y[a] + t * (y[b] - y[a])); });
            sums[begin / chunk] += window.cubed_distance(c);
        }
    });
    double total = 0;
    for (const double sum : sums)
        total += sum;
    return total / count;
}

/// The vertex value of `from`, at the places nearest to the vertices of `to`.
std::vector<double> carried_over(const std::vector<double>& value, const Surface& from, const Surface& to,
                                 const Progress& progress)
{
    const ClosestSearch nearest(from);
    const auto value_at = [&](const Point& place) {
        const ClosestPoint at = nearest(place);
        const Triangle& t = from.triangles[at.face];
        const Point normal = scaled_normal(from.points, t);
        Point weights;
        for (int k = 0; k < 3; ++k) {
            const Point& b = from.points[t[(k + 1) % 3]];
            const Point& c = from.points[t[(k + 2) % 3]];
            weights[k] = std::clamp((b - at.point).cross(c - at.point).dot(normal) / normal.squaredNorm(), 0.0, 1.0);
        }
        const auto nearer = [&](int a, int b) {
            return (from.points[a] - at.point).squaredNorm() < (from.points[b] - at.point).squaredNorm();
        };
        if (std::abs(weights.sum() - 1) < 1e-6)
            return weights.dot(Point(value[t[0]], value[t[1]], value[t[2]]));
        return value[*std::min_element(t.begin(), t.end(), nearer)]; // a needle
    };
    constexpr int chunk = 4096;
    std::vector<double> result(to.points.size());
    for_chunks(static_cast<int>(to.points.size()), chunk, progress, phase, [&](int begin, int end) {
        for (int v = begin; v < end; ++v)
            result[v] = value_at(to.points[v]);
    });
    return result;
}

} // namespace

std::vector<double> mean_curvature(const Surface& surface)
{
    // vcglib takes areas below a fixed size for none, and works in float: so it gets the mesh at a size of its own.
    const double scale = 1000 / bounding_diagonal(surface);
    Surface scaled = surface;
    const Point origin = surface.points[surface.triangles[0][0]];
    for (Point& p : scaled.points)
        p = scale * (p - origin);
    Mesh mesh;
    mesh.face.EnableFFAdjacency();
    to_mesh(scaled, mesh);
    vcg::tri::UpdateTopology<Mesh>::FaceFace(mesh);
    cut_at_non_manifold_edges(mesh);
    vcg::tri::UpdateCurvature<Mesh>::MeanAndGaussian(mesh);
    auto curvature = vcg::tri::Allocator<Mesh>::GetPerVertexAttribute<double>(mesh, "KH");
    std::vector<double> result(surface.points.size());
    for (std::size_t v = 0; v < result.size(); ++v)
        if (const double k = scale * std::abs(curvature[v]); std::isfinite(k))
            result[v] = k;
    for (const char* name : {"KH", "KG"}) // the mesh does not free what its attributes hold
        vcg::tri::Allocator<Mesh>::DeletePerVertexAttribute(mesh, name);
    return result;
}

double msdm(const Surface& reference, const Surface& measured, bool same_faces, const Progress& progress)
{
    const Eigen::AlignedBox3d box = bounding_box(reference.points);
    const double radius = 0.005 * box.diagonal().maxCoeff();
    const double c = 0.1 / box.diagonal().norm();
    report(progress, 0, "Curvature");
    std::vector<double> x;
    std::vector<double> y;
    side_by_side([&] { x = mean_curvature(reference); }, [&] { y = mean_curvature(measured); });
    report(progress, 20, "Curvature");
    if (same_faces)
        return std::cbrt(mean_cubed_distance(reference, x, y, radius, c, within(progress, 20, 100)));
    const std::vector<double> x_there = carried_over(x, reference, measured, within(progress, 20, 30));
    const double onto_measured = mean_cubed_distance(measured, x_there, y, radius, c, within(progress, 30, 60));
    const std::vector<double> y_there = carried_over(y, measured, reference, within(progress, 60, 70));
    const double onto_reference = mean_cubed_distance(reference, x, y_there, radius, c, within(progress, 70, 100));
    return (std::cbrt(onto_measured) + std::cbrt(onto_reference)) / 2;
}

} // namespace vcg_ext
