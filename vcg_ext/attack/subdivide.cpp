// SPDX-License-Identifier: GPL-3.0-or-later
#include "subdivide.h"

#include "../base/mesh.h"
#include "../base/progress.h"

#include <vcg/complex/algorithms/refine.h>

namespace vcg_ext {

Surface subdivide(const Surface& surface, int iterations, const Progress& progress)
{
    Mesh mesh;
    mesh.face.EnableFFAdjacency();
    to_mesh(surface, mesh);
    vcg::tri::EdgeLen<Mesh, double> every_edge(0);
    for (int i = 0; i < iterations; ++i) {
        report(progress, 100 * i / iterations, "Subdividing");
        vcg::tri::UpdateTopology<Mesh>::FaceFace(mesh);
        vcg::tri::RefineMidpoint(mesh, every_edge);
    }
    return to_surface(mesh);
}

} // namespace vcg_ext
