// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh.h"

namespace vcg_ext {

void to_mesh(const Surface& surface, Mesh& mesh)
{
    auto vertex = vcg::tri::Allocator<Mesh>::AddVertices(mesh, surface.points.size());
    for (const Point& p : surface.points)
        (vertex++)->P() = to_vcg(p);
    auto face = vcg::tri::Allocator<Mesh>::AddFaces(mesh, surface.triangles.size());
    for (const Triangle& t : surface.triangles) {
        for (int k = 0; k < 3; ++k)
            face->V(k) = &mesh.vert[t[k]];
        ++face;
    }
    vcg::tri::UpdateBounding<Mesh>::Box(mesh);
    vcg::tri::UpdateNormal<Mesh>::PerVertexNormalizedPerFaceNormalized(mesh);
}

Surface to_surface(const Mesh& mesh)
{
    Surface surface;
    surface.points.reserve(mesh.VN());
    surface.triangles.reserve(mesh.FN());
    std::vector<int> index(mesh.vert.size(), -1);
    for (std::size_t v = 0; v < mesh.vert.size(); ++v)
        if (!mesh.vert[v].IsD()) {
            index[v] = static_cast<int>(surface.points.size());
            surface.points.push_back(from_vcg(mesh.vert[v].cP()));
        }
    for (const Face& face : mesh.face)
        if (!face.IsD())
            surface.triangles.push_back({index[vcg::tri::Index(mesh, face.cV(0))],
                                         index[vcg::tri::Index(mesh, face.cV(1))],
                                         index[vcg::tri::Index(mesh, face.cV(2))]});
    return surface;
}

} // namespace vcg_ext
