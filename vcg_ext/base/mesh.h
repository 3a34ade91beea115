// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "surface.h"
#include "vcg_point.h"

#include <vcg/complex/complex.h>

namespace vcg_ext {

class Vertex;
class Face;
class Edge;
struct MeshTypes
    : vcg::UsedTypes<vcg::Use<Vertex>::AsVertexType, vcg::Use<Face>::AsFaceType, vcg::Use<Edge>::AsEdgeType> {};

/// vcglib has its face quality in float only; its remeshing compares it with the mesh's scalar.
template <class Base>
class FaceQualitydOcf : public vcg::face::QualityOcf<double, Base> {
};

/// What an algorithm of vcglib wants beyond positions is switched on where it is used (`Enable...`), as in MeshLab.
class Vertex : public vcg::Vertex<MeshTypes, vcg::vertex::InfoOcf, vcg::vertex::Coord3d, vcg::vertex::Normal3d,
                                  vcg::vertex::BitFlags, vcg::vertex::Qualityd, vcg::vertex::VFAdjOcf,
                                  vcg::vertex::MarkOcf, vcg::vertex::CurvatureDirdOcf> {};
class Face
    : public vcg::Face<MeshTypes, vcg::face::InfoOcf, vcg::face::VertexRef, vcg::face::Normal3d, vcg::face::BitFlags,
                       vcg::face::FFAdjOcf, vcg::face::VFAdjOcf, vcg::face::MarkOcf, FaceQualitydOcf> {};
class Edge : public vcg::Edge<MeshTypes, vcg::edge::VertexRef, vcg::edge::BitFlags> {};

/// The library's VCG mesh, in double. Lives inside the library only (see surface.h).
class Mesh : public vcg::tri::TriMesh<vcg::vertex::vector_ocf<Vertex>, vcg::face::vector_ocf<Face>, std::vector<Edge>> {
};

/// Fills the empty `mesh` with the surface, vertex by vertex and face by face in the same order; with normals and box.
void to_mesh(const Surface& surface, Mesh& mesh);

/// The vertices and faces of `mesh` that are not deleted, in order.
[[nodiscard]] Surface to_surface(const Mesh& mesh);

} // namespace vcg_ext
