// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh.h"

#include "../base/mesh.h"
#include "../base/progress.h"
#include "../base/weld.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vcg/complex/algorithms/isotropic_remeshing.h>
#include <vcg/space/index/grid_util.h>

namespace vcg_ext {

namespace {

using Allocator = vcg::tri::Allocator<Mesh>;

/// vcglib's components for remeshing: adjacency for the operations, marks for its searches.
void enable(Mesh& mesh)
{
    mesh.vert.EnableVFAdjacency();
    mesh.vert.EnableMark();
    mesh.face.EnableVFAdjacency();
    mesh.face.EnableFFAdjacency();
    mesh.face.EnableMark();
}

/// How many cells the grid has, over the box of all faces, in which vcglib searches for the nearest one: a surface
/// leaves most of them empty, and with one for each face remeshing takes a fifth longer.
constexpr int cells_per_face = 4;

/// The surface that is searched. vcglib makes one cell for each face that it is given, and takes up those that are not
/// deleted.
void to_searched(const Surface& surface, Mesh& mesh)
{
    mesh.face.EnableMark();
    to_mesh(surface, mesh);
    const int faces = static_cast<int>(surface.triangles.size());
    for (auto spare = Allocator::AddFaces(mesh, (cells_per_face - 1) * faces); spare != mesh.face.end(); ++spare)
        Allocator::DeleteFace(mesh, *spare);
}

/// How many faces a face shares its cell with, on average, in that grid: what one search looks at.
double faces_in_a_cell(const Surface& surface)
{
    const Eigen::AlignedBox3d box = bounding_box(surface);
    const Point extent = box.sizes();
    vcg::Point3i cells;
    vcg::BestDim(cells_per_face * static_cast<long long>(surface.triangles.size()), to_vcg(extent), cells);
    std::vector<int> held(static_cast<std::size_t>(cells[0]) * cells[1] * cells[2], 0);
    for (const Triangle& t : surface.triangles) {
        const Point centre = (surface.points[t[0]] + surface.points[t[1]] + surface.points[t[2]]) / 3;
        std::size_t cell = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double place = extent[axis] > 0 ? (centre[axis] - box.min()[axis]) / extent[axis] : 0;
            cell = cell * cells[axis] + std::clamp(static_cast<int>(place * cells[axis]), 0, cells[axis] - 1);
        }
        ++held[cell];
    }
    double sum = 0;
    for (const int count : held)
        sum += static_cast<double>(count) * count;
    return sum / static_cast<double>(surface.triangles.size());
}

/// A torus of a million even faces comes to 10, the most uneven mesh of libcgal-demo to 76.
constexpr int most_in_a_cell = 1000;

void check_spread(const Surface& surface)
{
    const double crowd = surface.triangles.empty() ? 0 : faces_in_a_cell(surface);
    if (crowd > most_in_a_cell)
        throw Error("The mesh is crowded into a small part of its bounding box: a search for the nearest face would "
                    "look at " +
                    std::to_string(std::llround(crowd)) + " of " + std::to_string(surface.triangles.size()) +
                    " faces, and remeshing take hours. Remove the vertices that lie far from all others first.");
}

} // namespace

Surface remesh(const Surface& surface, double length, int iterations, const Progress& progress)
{
    check_spread(surface);
    Mesh mesh;
    Mesh original;
    enable(mesh);
    to_mesh(surface, mesh);
    to_searched(surface, original);

    using Remeshing = vcg::tri::IsotropicRemeshing<Mesh>;
    Remeshing::Params parameters;
    parameters.SetTargetLen(length);
    parameters.SetFeatureAngleDeg(30);
    parameters.maxSurfDist = 0.01 * bounding_diagonal(surface);
    parameters.iter = 1;
    for (int i = 0; i < iterations; ++i) {
        report(progress, 100 * i / iterations, "Remeshing");
        parameters.cleanFlag = i == 0;
        parameters.userSelectedCreases = i > 0; // keep those found first
        Remeshing::Do(mesh, original, parameters);
    }
    return weld(to_surface(mesh)).surface;
}

} // namespace vcg_ext
