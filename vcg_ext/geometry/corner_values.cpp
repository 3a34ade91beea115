// SPDX-License-Identifier: GPL-3.0-or-later
#include "corner_values.h"

#include "../base/parallel.h"
#include "../base/weld.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

namespace vcg_ext {

namespace {

/// The mesh of what corners show: a vertex for each position and each set of values there. Seams are its borders.
struct Charts {
    std::vector<Triangle> triangles;        ///< as many as the cover has; of -1 where a face has no three positions
    std::vector<int> site;                  ///< per vertex of the charts its position
    std::vector<int> first_of_site;         ///< vertices of site s are first_of_site[s] to first_of_site[s + 1] - 1
    std::vector<std::array<int, 2>> corner; ///< per vertex a corner that shows it: face, corner
    VertexFaces around;                     ///< of the triangles

    [[nodiscard]] int vertices() const { return static_cast<int>(site.size()); }
    [[nodiscard]] bool on_seam(int v) const { return first_of_site[site[v] + 1] - first_of_site[site[v]] > 1; }
};

bool same(const CornerValues& values, const std::array<int, 2>& a, const std::array<int, 2>& b)
{
    const double* of_a = values.at(a[0], a[1]);
    return std::equal(of_a, of_a + values.channels, values.at(b[0], b[1]));
}

VertexFaces faces_around(int vertices, const std::vector<Triangle>& triangles)
{
    std::vector<Triangle> proper = triangles; // faces without three positions refer to a vertex of their own
    for (Triangle& t : proper)
        if (t[0] < 0)
            t = {vertices, vertices, vertices};
    return vertex_faces(vertices + 1, proper);
}

Charts charts_of(const Surface& cover, const std::vector<int>& site_of_vertex, int sites, const CornerValues& values)
{
    Charts charts;
    std::vector<Triangle> on_sites;
    for (const auto& [a, b, c] : cover.triangles) {
        const Triangle t{site_of_vertex[a], site_of_vertex[b], site_of_vertex[c]};
        const bool proper = *std::min_element(t.begin(), t.end()) >= 0 && t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
        on_sites.push_back(proper ? t : Triangle{-1, -1, -1});
    }
    charts.triangles.assign(cover.triangles.size(), {-1, -1, -1});
    const VertexFaces around = faces_around(sites, on_sites);
    charts.first_of_site.push_back(0);
    for (int s = 0; s < sites; ++s) {
        for (const int* f = around.begin(s); f != around.end(s); ++f) {
            const Triangle& t = on_sites[*f];
            const std::array<int, 2> corner{*f, t[0] == s ? 0 : t[1] == s ? 1 : 2};
            int v = charts.first_of_site[s];
            while (v < charts.vertices() && !same(values, charts.corner[v], corner))
                ++v;
            if (v == charts.vertices()) {
                charts.site.push_back(s);
                charts.corner.push_back(corner);
            }
            charts.triangles[*f][corner[1]] = v;
        }
        charts.first_of_site.push_back(charts.vertices());
    }
    charts.around = faces_around(charts.vertices(), charts.triangles);
    return charts;
}

/// A place on the cover: weights of the corners of a face.
struct Place {
    int face = -1;
    Point weights = Point::Zero();
    double distance = std::numeric_limits<double>::infinity(); ///< squared

    void nearer(const Place& other)
    {
        if (other.distance < distance)
            *this = other;
    }
};

/// Of the edge between corners `a` and `b` of a face the place nearest to `p`.
Place nearest_on_edge(const std::array<Point, 3>& corners, int face, int a, int b, const Point& p)
{
    const Point edge = corners[b] - corners[a];
    const double square = edge.squaredNorm();
    const double part = square > 0 ? std::clamp((p - corners[a]).dot(edge) / square, 0.0, 1.0) : 0;
    Place place;
    place.face = face;
    place.weights[a] = 1 - part;
    place.weights[b] = part;
    place.distance = (corners[a] + part * edge - p).squaredNorm();
    return place;
}

Place nearest_on_face(const std::array<Point, 3>& corners, int face, const Point& p)
{
    const Point normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double square = normal.squaredNorm();
    if (square > 0) {
        Place place;
        place.face = face;
        for (int k = 0; k < 3; ++k)
            place.weights[k] =
                (corners[(k + 2) % 3] - corners[(k + 1) % 3]).cross(p - corners[(k + 1) % 3]).dot(normal) / square;
        if (place.weights.minCoeff() >= 0) {
            place.distance = std::pow((p - corners[0]).dot(normal), 2) / square;
            return place;
        }
    }
    Place place = nearest_on_edge(corners, face, 0, 1, p);
    place.nearer(nearest_on_edge(corners, face, 1, 2, p));
    place.nearer(nearest_on_edge(corners, face, 2, 0, p));
    return place;
}

/// Finds the places of the charts' vertices.
class Places {
public:
    Places(const Charts& charts, const Points& sites) : charts_(charts), sites_(sites) {}

    /// Where the charts' vertex `v` finds its values, now that it is at `p`.
    [[nodiscard]] Place operator()(int v, const Point& p) const
    {
        return charts_.on_seam(v) ? along_seam(v, p) : within_chart(v, p);
    }

private:
    [[nodiscard]] std::array<Point, 3> corners(int face) const
    {
        const Triangle& t = charts_.triangles[face];
        return {sites_[charts_.site[t[0]]], sites_[charts_.site[t[1]]], sites_[charts_.site[t[2]]]};
    }

    void take_around(int v, const Point& p, Place& best) const
    {
        for (const int* f = charts_.around.begin(v); f != charts_.around.end(v); ++f)
            best.nearer(nearest_on_face(corners(*f), *f, p));
    }

    /// Walks from face to face as long as that leads nearer.
    [[nodiscard]] Place within_chart(int v, const Point& p) const
    {
        constexpr int most_steps = 50;
        Place best;
        take_around(v, p, best);
        for (int step = 0; step < most_steps; ++step) {
            const Place before = best;
            for (const int w : charts_.triangles[before.face])
                take_around(w, p, best);
            if (best.face == before.face)
                break;
        }
        return best;
    }

    /// Whether the charts' edge from `v` to the site `to` is a border of its chart; if so, of which face.
    [[nodiscard]] int border_face(int v, int to) const
    {
        int found = -1;
        for (const int* f = charts_.around.begin(v); f != charts_.around.end(v); ++f)
            for (const int w : charts_.triangles[*f])
                if (charts_.site[w] == to) {
                    if (found >= 0)
                        return -1;
                    found = *f;
                }
        return found;
    }

    /// The seam's edges at `v` are borders of all charts there.
    [[nodiscard]] Place along_seam(int v, const Point& p) const
    {
        const int s = charts_.site[v];
        Place best = kept(v);
        best.distance = (sites_[s] - p).squaredNorm();
        for (const int* f = charts_.around.begin(v); f != charts_.around.end(v); ++f)
            for (const int w : charts_.triangles[*f]) {
                const int to = charts_.site[w];
                if (w == v || border_face(v, to) != *f)
                    continue;
                bool of_all = true;
                for (int other = charts_.first_of_site[s]; other < charts_.first_of_site[s + 1]; ++other)
                    of_all = of_all && border_face(other, to) >= 0;
                if (of_all)
                    best.nearer(nearest_on_edge(corners(*f), *f, corner_of(*f, v), corner_of(*f, w), p));
            }
        return best;
    }

    [[nodiscard]] Place kept(int v) const
    {
        Place place;
        place.face = charts_.corner[v][0];
        place.weights[charts_.corner[v][1]] = 1;
        return place;
    }

    [[nodiscard]] int corner_of(int face, int v) const
    {
        const Triangle& t = charts_.triangles[face];
        return t[0] == v ? 0 : t[1] == v ? 1 : 2;
    }

    const Charts& charts_;
    const Points& sites_;
};

/// A triangle laid flat: columns are its edges from the first corner.
Eigen::Matrix2d laid_flat(const std::array<Point, 3>& corners)
{
    const Point first = corners[1] - corners[0];
    const Point second = corners[2] - corners[0];
    const double length = first.norm();
    const double along = length > 0 ? first.dot(second) / length : 0;
    Eigen::Matrix2d flat;
    flat << length, along, 0, std::sqrt(std::max(0.0, second.squaredNorm() - along * along));
    return flat;
}

/// The largest factor by which a length grows or shrinks between two triangles; 1 where one has no area.
double stretch_between(const std::array<Point, 3>& before, const std::array<Point, 3>& after)
{
    const Eigen::Matrix2d from = laid_flat(before);
    const Eigen::Matrix2d to = laid_flat(after);
    if (!(std::abs(from.determinant()) > 0 && std::abs(to.determinant()) > 0))
        return 1;
    const Eigen::JacobiSVD<Eigen::Matrix2d> svd(to * from.inverse());
    return std::max(svd.singularValues()[0], 1 / svd.singularValues()[1]);
}

double quantile(std::vector<double> values, double share)
{
    if (values.empty())
        return 1;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

} // namespace

CarriedValues carried_values(const Surface& cover, const CornerValues& values, const Points& moved)
{
    const Welded welded = weld(cover);
    const Points& sites = welded.surface.points;
    Points site_now = sites;
    for (std::size_t v = 0; v < moved.size(); ++v)
        if (welded.site_of_vertex[v] >= 0)
            site_now[welded.site_of_vertex[v]] = moved[v];
    const Charts charts = charts_of(cover, welded.site_of_vertex, static_cast<int>(sites.size()), values);
    const Places find(charts, sites);
    std::vector<Place> taken_from(charts.vertices());
    Points places(charts.vertices()); // on the cover
    for_each_index(charts.vertices(), [&](int v) {
        const int s = charts.site[v];
        places[v] = sites[s];
        if (site_now[s] == sites[s])
            return;
        taken_from[v] = find(v, site_now[s]);
        places[v].setZero();
        for (int k = 0; k < 3; ++k)
            places[v] += taken_from[v].weights[k] * sites[charts.site[charts.triangles[taken_from[v].face][k]]];
    });

    CarriedValues result{values, 1};
    std::vector<double> stretches(cover.triangles.size(), 1);
    for_each_index(static_cast<int>(cover.triangles.size()), [&](int f) {
        const Triangle& t = charts.triangles[f];
        if (t[0] < 0)
            return;
        for (int k = 0; k < 3; ++k) {
            const Place& place = taken_from[t[k]];
            if (place.face < 0)
                continue;
            for (int c = 0; c < values.channels; ++c) {
                double sum = 0;
                for (int corner = 0; corner < 3; ++corner)
                    sum += place.weights[corner] * values.at(place.face, corner)[c];
                result.values.at(f, k)[c] = sum;
            }
        }
        if (std::none_of(t.begin(), t.end(), [&](int v) { return taken_from[v].face >= 0; }))
            return;
        stretches[f] =
            stretch_between({places[t[0]], places[t[1]], places[t[2]]},
                            {site_now[charts.site[t[0]]], site_now[charts.site[t[1]]], site_now[charts.site[t[2]]]});
    });
    result.stretch = quantile(std::move(stretches), 0.95);
    return result;
}

std::vector<char> on_seams(const Surface& cover, const CornerValues& values)
{
    const Welded welded = weld(cover);
    const Charts charts =
        charts_of(cover, welded.site_of_vertex, static_cast<int>(welded.surface.points.size()), values);
    std::vector<char> result(cover.points.size(), 0);
    for (std::size_t v = 0; v < result.size(); ++v)
        if (const int site = welded.site_of_vertex[v]; site >= 0)
            result[v] = static_cast<char>(charts.first_of_site[site + 1] - charts.first_of_site[site] > 1);
    return result;
}

} // namespace vcg_ext
