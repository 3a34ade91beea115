// SPDX-License-Identifier: GPL-3.0-or-later
#include "isosurface.h"

#include "../base/mesh.h"
#include "../base/parallel.h"
#include "../geometry/closest.h"

#include <algorithm>
#include <cmath>
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized" // in vcglib's marching cubes, past its assertions
#include <vcg/complex/algorithms/create/marching_cubes.h>
#include <vcg/complex/algorithms/create/mc_trivial_walker.h>

namespace vcg_ext {

namespace {

/// The signed distance at the nodes of a grid, in cells; in the form in which vcglib's walker takes a volume.
class Volume {
public:
    Volume(const Point& origin, double cell, const std::array<int, 3>& size)
        : origin_(origin), cell_(cell), size_(size), value_(static_cast<std::size_t>(size[0]) * size[1] * size[2])
    {
    }

    [[nodiscard]] std::size_t at(int i, int j, int k) const
    {
        return i + static_cast<std::size_t>(size_[0]) * (j + static_cast<std::size_t>(size_[1]) * k);
    }
    [[nodiscard]] Point node(int i, int j, int k) const { return origin_ + cell_ * Point(i, j, k); }
    [[nodiscard]] const std::array<int, 3>& size() const { return size_; }
    [[nodiscard]] double cell() const { return cell_; }
    [[nodiscard]] float& value(int i, int j, int k) { return value_[at(i, j, k)]; }
    [[nodiscard]] float value(int i, int j, int k) const { return value_[at(i, j, k)]; }

    /// Whether the surface passes between two corners of the cell whose lowest corner this is.
    [[nodiscard]] bool crossed(int i, int j, int k) const
    {
        const bool sign = value(i, j, k) > 0;
        for (int corner = 1; corner < 8; ++corner)
            if ((value(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2)) > 0) != sign)
                return true;
        return false;
    }

    // What vcg::tri::TrivialWalker asks for.
    [[nodiscard]] vcg::Point3i ISize() const { return {size_[0], size_[1], size_[2]}; }
    [[nodiscard]] float Val(int i, int j, int k) const { return value(i, j, k); }
    [[nodiscard]] bool ValidCell(const vcg::Point3i& low, const vcg::Point3i&) const
    {
        return crossed(low[0], low[1], low[2]);
    }
    void GetXIntercept(const vcg::Point3i& a, const vcg::Point3i& b, Vertex* v, float) const { intercept(a, b, v); }
    void GetYIntercept(const vcg::Point3i& a, const vcg::Point3i& b, Vertex* v, float) const { intercept(a, b, v); }
    void GetZIntercept(const vcg::Point3i& a, const vcg::Point3i& b, Vertex* v, float) const { intercept(a, b, v); }

private:
    void intercept(const vcg::Point3i& a, const vcg::Point3i& b, Vertex* v) const
    {
        const double fa = value(a[0], a[1], a[2]);
        const double fb = value(b[0], b[1], b[2]);
        const Point p = node(a[0], a[1], a[2]) + fa / (fa - fb) * (node(b[0], b[1], b[2]) - node(a[0], a[1], a[2]));
        v->P() = to_vcg(p);
    }

    Point origin_;
    double cell_;
    std::array<int, 3> size_;
    std::vector<float> value_;
};

/// A border, or where for another reason an odd number of faces meets.
int odd_edges(const std::vector<Triangle>& triangles)
{
    std::vector<std::pair<int, int>> edges;
    edges.reserve(3 * triangles.size());
    for (const Triangle& t : triangles)
        for (int k = 0; k < 3; ++k)
            edges.push_back(std::minmax(t[k], t[(k + 1) % 3]));
    std::sort(edges.begin(), edges.end());
    int odd = 0;
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        while (end < edges.size() && edges[end] == edges[begin])
            ++end;
        odd += (end - begin) % 2 == 1;
    }
    return odd;
}

/// Whether the line along x through (y, z) passes through the triangle. Seen along x, the line is a point and the
/// triangle contains it where a ray along y crosses the outline an odd number of times. Each edge is looked at in one
/// direction, whichever face it belongs to: so the faces of a closed surface are hit an even number of times in all,
/// without fail.
bool line_hits(const Points& points, const Triangle& t, double y, double z)
{
    bool inside = false;
    for (int k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
        const Point& a = points[low];
        const Point& b = points[high];
        if ((a.z() > z) != (b.z() > z) && y < a.y() + (z - a.z()) / (b.z() - a.z()) * (b.y() - a.y()))
            inside = !inside;
    }
    return inside;
}

/// Where that line passes through the triangle's plane, kept within the triangle's extent.
double crossing(const Points& points, const Triangle& t, double y, double z)
{
    const Point& a = points[t[0]];
    const Point n = scaled_normal(points, t);
    const auto [low, high] = std::minmax({a.x(), points[t[1]].x(), points[t[2]].x()});
    const double x = n.x() == 0 ? a.x() : a.x() - ((y - a.y()) * n.y() + (z - a.z()) * n.z()) / n.x();
    return std::clamp(x, low, high);
}

/// Sets every node to 1 outside and -1 inside, by parity along the lines in x.
void set_signs(Volume& volume, const Surface& surface)
{
    const auto& [nx, ny, nz] = volume.size();
    std::vector<char> flips(static_cast<std::size_t>(nx) * ny * nz, 0);
    const Point origin = volume.node(0, 0, 0);
    const auto first_node = [&](double x, int axis) {
        return static_cast<int>(std::ceil((x - origin[axis]) / volume.cell()));
    };
    for (const Triangle& t : surface.triangles) {
        Point low = surface.points[t[0]];
        Point high = low;
        for (const int v : t) {
            low = low.cwiseMin(surface.points[v]);
            high = high.cwiseMax(surface.points[v]);
        }
        for (int k = first_node(low.z(), 2) - 1; k <= first_node(high.z(), 2); ++k)
            for (int j = first_node(low.y(), 1) - 1; j <= first_node(high.y(), 1); ++j) {
                const Point line = volume.node(0, j, k);
                if (line_hits(surface.points, t, line.y(), line.z()))
                    flips[volume.at(first_node(crossing(surface.points, t, line.y(), line.z()), 0), j, k)] ^= 1;
            }
    }
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j) {
            char inside = 0;
            for (int i = 0; i < nx; ++i) {
                inside ^= flips[volume.at(i, j, k)];
                volume.value(i, j, k) = inside ? -1.0f : 1.0f;
            }
        }
}

/// Puts the distance where marching cubes will look: at the corners of crossed cells.
void set_distances(Volume& volume, const Surface& surface, const Progress& progress)
{
    const int nx = volume.size()[0];
    const int ny = volume.size()[1];
    const int nz = volume.size()[2];
    std::vector<char> wanted(static_cast<std::size_t>(nx) * ny * nz, 0);
    for (int k = 0; k + 1 < nz; ++k)
        for (int j = 0; j + 1 < ny; ++j)
            for (int i = 0; i + 1 < nx; ++i)
                if (volume.crossed(i, j, k))
                    for (int corner = 0; corner < 8; ++corner)
                        wanted[volume.at(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2))] = 1;

    const ClosestSearch nearest(surface);
    report(progress, 30, "Distances");
    for_chunks(nz, 1, [&](int begin, int end) {
        for (int k = begin; k < end; ++k)
            for (int j = 0; j < ny; ++j)
                for (int i = 0; i < nx; ++i)
                    if (wanted[volume.at(i, j, k)]) {
                        const double cells = nearest(volume.node(i, j, k)).distance / volume.cell();
                        // Not nearer than a hundredth: else vertices on several edges of one node fall together.
                        volume.value(i, j, k) *= static_cast<float>(std::clamp(cells, 0.01, 2.0));
                    }
    });
}

} // namespace

Surface isosurface(const Surface& surface, double cell, const Progress& progress)
{
    if (const int odd = odd_edges(surface.triangles))
        throw Error("The signed distance needs a closed mesh, but " + std::to_string(odd) +
                    " edges are borders or have an odd number of faces. Close the holes and repair these edges first.");

    const Eigen::AlignedBox3d box = bounding_box(surface.points);
    constexpr int margin = 3;
    std::array<int, 3> size{};
    for (int axis = 0; axis < 3; ++axis)
        size[axis] = static_cast<int>(std::ceil(box.diagonal()[axis] / cell)) + 2 * margin + 1;
    // Off the box by odd parts of a cell, so that flat sides and corners do not lie on nodes.
    Volume volume(box.min() - cell * (Point::Constant(margin) - Point(0.381966, 0.267949, 0.414214)), cell, size);
    report(progress, 0, "Inside and outside");
    set_signs(volume, surface);
    set_distances(volume, surface, progress);

    report(progress, 80, "Marching cubes");
    Mesh mesh;
    vcg::tri::TrivialWalker<Mesh, Volume> walker;
    vcg::tri::MarchingCubes<Mesh, vcg::tri::TrivialWalker<Mesh, Volume>> cubes(mesh, walker);
    walker.BuildMesh(mesh, volume, cubes, 0);
    if (mesh.fn == 0)
        throw Error("No cell centre lies inside the mesh, so its isosurface is empty. Choose smaller cells.");
    return to_surface(mesh);
}

} // namespace vcg_ext
