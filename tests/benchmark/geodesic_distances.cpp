// SPDX-License-Identifier: GPL-3.0-or-later
// Geodesic distances as the watermark sees them, one vertex a line: for the comparison with an exact solver and for
// pictures. Usage: geodesic_distances MESH vertex NUMBER    from a vertex
//        geodesic_distances MESH key TEXT         from the point that the key chooses
// MESH is one of the test meshes, such as bunny00.off.

#include "support/load.h"
#include "vcg_ext/base/error.h"
#include "vcg_ext/carrier/strips.h"
#include "vcg_ext/key/key.h"

#include <cstdio>
#include <cstring>

using namespace vcg_ext;

int main(int count, char** arguments)
try {
    if (count != 4)
        throw Error("Usage: geodesic_distances MESH vertex NUMBER | MESH key TEXT");
    const Surface surface = load(arguments[1]);
    const VertexFaces around = vertex_faces(static_cast<int>(surface.points.size()), surface.triangles);
    SurfacePoint source;
    if (std::strcmp(arguments[2], "key") == 0) {
        source =
            strip_frame(surface, principal_frame(surface), source_directions(Key(arguments[3]).stream("direction")))
                .source;
    } else {
        const int vertex = std::stoi(arguments[3]);
        source = {*around.begin(vertex), surface.points.at(vertex)};
    }
    for (const double distance :
         distances_from(source, surface.points, surface.triangles, fans_of(around, surface.triangles)))
        std::printf("%.17g\n", distance);
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
