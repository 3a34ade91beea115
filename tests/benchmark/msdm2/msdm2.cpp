// SPDX-License-Identifier: GPL-3.0-or-later
// MSDM2 (Lavoue 2011) as MEPP2 computes it: of each mesh against the first, three levels, both ways and their mean.
// Usage: msdm2 ORIGINAL.off MESH.off...
//
// Built by hand, where the sources of https://github.com/MEPP-team/MEPP2 (GPL) are; needs libcgal-dev and libeigen3-dev:
//
//     sed -i '/generic_reader.hpp\|generic_writer.hpp/d' FEVV/Filters/CGAL/Surface_mesh/msdm2.h
//     sed -i 's/size_of_vertices(/num_vertices(/' FEVV/Filters/CGAL/Surface_mesh/msdm2.h
//     g++ -std=c++17 -O2 -w -I. -IBase -DCGAL_EIGEN3_ENABLED -I/usr/include/eigen3 -o msdm2 .../msdm2.cpp -lgmp -lmpfr
//
// (its readers would want CImg, its curvature and metric nothing but CGAL and Eigen).

#include "FEVV/Filters/CGAL/Surface_mesh/msdm2.h"
#include "Examples/CGAL/Surface_mesh/Lib_msdm2/msdm2_surfacemesh.h"
#include "FEVV/Filters/Generic/calculate_face_normals.hpp"

#include <CGAL/Surface_mesh/IO.h>
#include <cstdio>
#include <fstream>

namespace {

using msdm2::MeshT;

MeshT read(const char* path)
{
    MeshT mesh;
    std::ifstream file(path);
    if (!CGAL::IO::read_OFF(file, mesh)) {
        std::fprintf(stderr, "%s cannot be read\n", path);
        std::exit(1);
    }
    return mesh;
}

double one_way(const MeshT& degraded, const MeshT& original)
{
    using Normals = FEVV::PMap_traits<FEVV::face_normal_t, MeshT>::pmap_type;
    const auto degraded_points = get(boost::vertex_point, degraded),
               original_points = get(boost::vertex_point, original);
    Normals degraded_normals = make_property_map(FEVV::face_normal, degraded);
    Normals original_normals = make_property_map(FEVV::face_normal, original);
    FEVV::Filters::calculate_face_normals(degraded, degraded_points, degraded_normals);
    FEVV::Filters::calculate_face_normals(original, original_points, original_normals);
    FEVV::PMapsContainer degraded_maps, original_maps;
    msdm2::Msdm2MapT local(get(boost::vertex_index, degraded));
    const int levels = 3;
    double value = 0;
    FEVV::Filters::process_msdm2_multires(degraded, degraded_points, degraded_normals, degraded_maps, original,
                                          original_points, original_normals, original_maps, levels, local, value);
    return value;
}

} // namespace

int main(int argc, char** argv)
{
    const MeshT original = read(argv[1]);
    for (int i = 2; i < argc; ++i) {
        const MeshT mesh = read(argv[i]);
        const double there = one_way(mesh, original), back = one_way(original, mesh);
        std::printf("RESULT %s %.6f %.6f %.6f\n", argv[i], there, back, (there + back) / 2);
        std::fflush(stdout);
    }
}
