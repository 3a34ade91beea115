#include "remesh.h"

#include "../mesh.h"

#include <vcg/complex/algorithms/isotropic_remeshing.h>

namespace vcg_ext {

namespace {

/// vcglib's components for remeshing: adjacency for the operations, marks for its searches.
void enable(Mesh& mesh)
{
    mesh.vert.EnableVFAdjacency();
    mesh.vert.EnableMark();
    mesh.face.EnableVFAdjacency();
    mesh.face.EnableFFAdjacency();
    mesh.face.EnableMark();
}

} // namespace

double mean_edge_length(const Surface& surface)
{
    double sum = 0;
    for (const Triangle& t : surface.triangles)
        for (int k = 0; k < 3; ++k)
            sum += (surface.points[t[k]] - surface.points[t[(k + 1) % 3]]).norm();
    return surface.triangles.empty() ? 0 : sum / (3 * static_cast<double>(surface.triangles.size()));
}

Surface remesh(const Surface& surface, double length, int iterations, const Progress& progress)
{
    Mesh mesh;
    Mesh original;
    enable(mesh);
    enable(original);
    to_mesh(surface, mesh);
    to_mesh(surface, original);

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
