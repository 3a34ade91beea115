// SPDX-License-Identifier: GPL-3.0-or-later
#include "normals.h"

#include <vcg_ext/base/parallel.h>
#include <vcg_ext/base/prefetch.h>

#include <algorithm>

namespace {

/// The corners with their shares in the vertices' normals: the face's normal, weighted by the angle.
std::array<NormalShares::Corner, 3> corners_of(CFaceO& face)
{
    const Point3m& normal = face.N();
    const auto edge = [&](int j) { return (face.cP((j + 1) % 3) - face.cP(j)).Normalize(); };
    const Point3m e0 = edge(0);
    const Point3m e1 = edge(1);
    const Point3m e2 = edge(2);
    return {{{face.V(0), normal * vcg::AngleN(e0, -e2)},
             {face.V(1), normal * vcg::AngleN(-e0, e1)},
             {face.V(2), normal * vcg::AngleN(-e1, e2)}}};
}

/// The normals of `count` faces from `first` on, and what they add to their corners'.
void find_shares(CMeshO& mesh, std::size_t first, int count, NormalShares& shares)
{
    vcg_ext::for_each_index(count, [&](int i) {
        CFaceO& face = mesh.face[first + i];
        if (i + vcg_ext::elements_ahead < count)
            for (int corner = 0; corner < 3; ++corner)
                vcg_ext::prefetch(mesh.face[first + i + vcg_ext::elements_ahead].cV(corner));
        if (face.IsD()) {
            for (NormalShares::Corner& corner : shares.corners[i])
                corner.vertex = nullptr;
            return;
        }
        face.N() = vcg::TriangleNormal(face).Normalize();
        shares.corners[i] = corners_of(face);
    });
}

/// Adds the shares of `count` faces: each half of the vertices by one thread, each vertex' terms in order.
void add_shares(CMeshO& mesh, int count, NormalShares& shares)
{
    const CVertexO* middle = mesh.vert.data() + mesh.vert.size() / 2;
    vcg_ext::for_chunks(2, 1, [&](int half, int) {
        for (int i = 0; i < count; ++i) {
            if (i + vcg_ext::elements_ahead < count)
                for (const auto& later : shares.corners[i + vcg_ext::elements_ahead])
                    vcg_ext::prefetch(later.vertex);
            for (const auto& [vertex, share] : shares.corners[i]) {
                if (!vertex || (vertex < middle) != (half == 0))
                    continue;
                char& begun = shares.begun[vertex - mesh.vert.data()];
                vertex->N() = begun ? vertex->N() + share : share;
                begun = 1;
            }
        }
    });
}

} // namespace

void update_box_and_normals(CMeshO& mesh, NormalShares& shares)
{
    mesh.bbox = vcg_ext::ordered_fold(
        int(mesh.vert.size()), Box3m(),
        [&mesh](Box3m& box, int v) {
            if (!mesh.vert[v].IsD())
                box.Add(mesh.vert[v].cP());
        },
        [](Box3m& box, const Box3m& part) { box.Add(part); });
    std::fill(shares.begun.begin(), shares.begun.end(), 0);
    for (std::size_t first = 0; first < mesh.face.size(); first += NormalShares::faces) {
        const int count = int(std::min<std::size_t>(NormalShares::faces, mesh.face.size() - first));
        find_shares(mesh, first, count, shares);
        add_shares(mesh, count, shares);
    }
}
