// SPDX-License-Identifier: GPL-3.0-or-later
#include "body.h"

#include "../base/check.h"
#include "../base/parallel.h"
#include "orient.h"
#include "parts.h"
#include "sew.h"
#include "size.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vcg_ext {

namespace {

constexpr double seam = 3e-4;      ///< of the square root of the area, which no stray triangle far off changes
constexpr double loose = 0.01;     ///< of the area
constexpr double most_loose = 0.5; ///< of the area, all together

/// Puts each site where `site_of` says, `points` being those of the new sites, and leaves out faces that lose a corner.
void put_on_sites(Body& body, const std::vector<int>& site_of, Points points)
{
    std::vector<Triangle> triangles;
    triangles.reserve(body.surface.triangles.size());
    for (const auto& [a, b, c] : body.surface.triangles) {
        const Triangle t{site_of[a], site_of[b], site_of[c]};
        if (t[0] >= 0 && t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
            triangles.push_back(t);
    }
    for (int& site : body.site_of_vertex)
        if (site >= 0)
            site = site_of[site];
    body.surface = {std::move(points), std::move(triangles)};
}

/// Keeps the sites for which `keep(site)` holds.
template <class Keep>
void keep_sites(Body& body, const Keep& keep)
{
    std::vector<int> site_of(body.surface.points.size(), -1);
    Points points;
    for (std::size_t s = 0; s < site_of.size(); ++s)
        if (keep(static_cast<int>(s))) {
            site_of[s] = static_cast<int>(points.size());
            points.push_back(body.surface.points[s]);
        }
    put_on_sites(body, site_of, std::move(points));
}

/// Makes one site, at their mean, of those that lie together.
void join_sites(Body& body, const std::vector<int>& head)
{
    std::vector<int> site_of(head.size());
    std::vector<int> count;
    Points points;
    for (std::size_t v = 0; v < head.size(); ++v) { // a head may come after those that it holds
        if (head[v] != static_cast<int>(v))
            continue;
        site_of[v] = static_cast<int>(points.size());
        points.emplace_back(body.surface.points[v]);
        count.push_back(1);
    }
    for (std::size_t v = 0; v < head.size(); ++v) {
        if (head[v] == static_cast<int>(v))
            continue;
        const int site = site_of[v] = site_of[head[v]];
        points[site] += (body.surface.points[v] - points[site]) / ++count[site];
    }
    put_on_sites(body, site_of, std::move(points));
    std::vector<char> used(body.surface.points.size(), 0);
    for (const Triangle& t : body.surface.triangles)
        for (const int v : t)
            used[v] = 1;
    if (std::find(used.begin(), used.end(), 0) != used.end())
        keep_sites(body, [&](int s) { return used[s] != 0; });
}

void mend(Body& body)
{
    std::vector<EdgeUse> edges = boundary(body.surface);
    body.closed = edges.empty();
    if (body.closed)
        return;
    const std::vector<int> head = sewn_to(body.surface.points, edges, seam * std::sqrt(surface_area(body.surface)));
    for (std::size_t v = 0; v < head.size(); ++v)
        if (head[v] != static_cast<int>(v)) {
            join_sites(body, head);
            edges = boundary(body.surface);
            break;
        }
    if (std::any_of(edges.begin(), edges.end(), [](const EdgeUse& e) { return e.faces == 2; }))
        orient_alike(body.surface);
}

void leave_out_loose_pieces(Body& body)
{
    const Surface& surface = body.surface;
    const std::vector<int> piece = pieces_of(surface);
    const int vertices = static_cast<int>(surface.points.size());
    body.pieces = ordered_sum(vertices, 0, [&](int v) { return piece[v] == v; });
    if (body.pieces == 1)
        return;
    std::vector<double> area(surface.points.size(), 0); // of the piece, at the site that names it
    double total = 0;
    for (const Triangle& t : surface.triangles) {
        const double a = scaled_normal(surface.points, t).norm();
        area[piece[t[0]]] += a;
        total += a;
    }
    const auto is_loose = [&](int v) { return area[piece[v]] < loose * total; };
    double together = 0;
    int count = 0;
    for (int v = 0; v < vertices; ++v)
        if (piece[v] == v && is_loose(v)) {
            together += area[v];
            ++count;
        }
    if (count == 0 || together > most_loose * total)
        return;
    body.loose_pieces = count;
    keep_sites(body, [&](int v) { return !is_loose(v); });
}

} // namespace

Body body_of(Surface surface, const char* which)
{
    Welded welded = checked_weld(std::move(surface), which);
    Body body{std::move(welded.surface), std::move(welded.site_of_vertex)};
    mend(body);
    leave_out_loose_pieces(body);
    return body;
}

std::optional<Points> sites_moved(const Body& before, const Points& moved)
{
    const std::vector<int>& site_of = before.site_of_vertex;
    const int vertices = static_cast<int>(site_of.size());
    if (!before.closed || before.pieces > 1 || *std::min_element(site_of.begin(), site_of.end()) < 0)
        return {};
    Points sites(before.surface.points.size());
    for (int v = vertices - 1; v >= 0; --v) // the first of each is the last that stays
        sites[site_of[v]] = moved[v];
    if (ordered_sum(vertices, 0, [&](int v) { return moved[v] != sites[site_of[v]]; }) > 0 ||
        !is_identity(first_equals(sites)))
        return {};
    return sites;
}

std::string about_loose_pieces(const Body& body)
{
    if (body.loose_pieces == 0)
        return {};
    return std::to_string(body.loose_pieces) + " of the " + std::to_string(body.pieces) +
           " separate pieces of the mesh are below 1 % of its area, and carry nothing.";
}

Points with_sites_at(const Body& body, const Points& original, const Points& sites)
{
    Points points(original.size());
    for_each_index(static_cast<int>(points.size()), [&](int v) {
        const int site = body.site_of_vertex[v];
        points[v] = original[v];
        if (site < 0)
            return;
        const Point& before = body.surface.points[site];
        points[v] = points[v] == before ? sites[site] : points[v] + (sites[site] - before);
    });
    return points;
}

} // namespace vcg_ext
