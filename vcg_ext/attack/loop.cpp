// SPDX-License-Identifier: GPL-3.0-or-later
#include "loop.h"

#include "../base/mesh.h"
#include "../base/progress.h"

#include <vcg/complex/algorithms/clean.h>
#include <vcg/complex/algorithms/refine.h>
#include <vcg/complex/algorithms/refine_loop.h>

namespace vcg_ext {

Surface subdivide_by_loop(const Surface& surface, int iterations, const Progress& progress)
{
    Mesh mesh;
    mesh.face.EnableFFAdjacency();
    to_mesh(surface, mesh);
    for (int i = 0; i < iterations; ++i) {
        report(progress, 100 * i / iterations, "Subdividing");
        vcg::tri::UpdateTopology<Mesh>::FaceFace(mesh);
        if (vcg::tri::Clean<Mesh>::CountNonManifoldEdgeFF(mesh) > 0)
            throw Error("An edge of the mesh has more than two faces, and Loop's subdivision knows no such. Clean it "
                        "first (Repair non Manifold Edges), or use Subdivide.");
        vcg::tri::RefineOddEven<Mesh>(mesh, vcg::tri::OddPointLoop<Mesh>(mesh), vcg::tri::EvenPointLoop<Mesh>(), 0.0F);
    }
    return to_surface(mesh);
}

} // namespace vcg_ext
