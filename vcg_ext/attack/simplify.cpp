// SPDX-License-Identifier: GPL-3.0-or-later
#include "simplify.h"

#include "../base/mesh.h"

#pragma GCC diagnostic ignored "-Wmaybe-uninitialized" // a placement of vcglib that is not used here, see below
#include <vcg/complex/algorithms/local_optimization/tri_edge_collapse_quadric.h>

namespace vcg_ext {

namespace {

/// Where the collapse keeps each vertex' quadric. vcglib asks for it as a static; it is one per thread, so that two
/// attacks can go on at once.
struct Quadrics {
    using Quadric = vcg::math::Quadric<double>;
    static vcg::SimpleTempData<Mesh::VertContainer, Quadric>*& data()
    {
        static thread_local vcg::SimpleTempData<Mesh::VertContainer, Quadric>* quadrics = nullptr;
        return quadrics;
    }
    /// Sets the place until it ends, whichever way.
    class Here {
    public:
        explicit Here(vcg::SimpleTempData<Mesh::VertContainer, Quadric>& quadrics) { data() = &quadrics; }
        ~Here() { data() = nullptr; }
        Here(const Here&) = delete;
        Here& operator=(const Here&) = delete;
    };
    static void Init() {}
    static Quadric& Qd(Vertex& v) { return (*data())[v]; }
    static Quadric& Qd(Vertex* v) { return (*data())[*v]; }
    static double W(Vertex*) { return 1; }
    static double W(Vertex&) { return 1; }
    static void Merge(Vertex&, const Vertex&) {}
};

using Pair = vcg::tri::BasicVertexPair<Vertex>;

class Collapse : public vcg::tri::TriEdgeCollapseQuadric<Mesh, Pair, Collapse, Quadrics> {
public:
    using Base = vcg::tri::TriEdgeCollapseQuadric<Mesh, Pair, Collapse, Quadrics>;
    Collapse(const Pair& pair, int mark, vcg::BaseParameterClass* parameters) : Base(pair, mark, parameters) {}
};

} // namespace

Surface simplify(const Surface& surface, int faces, const Progress& progress)
{
    Mesh mesh;
    mesh.vert.EnableVFAdjacency();
    mesh.vert.EnableMark();
    mesh.face.EnableVFAdjacency();
    to_mesh(surface, mesh);
    vcg::SimpleTempData<Mesh::VertContainer, Quadrics::Quadric> quadrics(mesh.vert);
    const Quadrics::Here here(quadrics);

    vcg::tri::TriEdgeCollapseQuadricParameter parameters;
    parameters.SVDPlacement = true; // the other way to the optimum leaves the place unset where a quadric is singular
    vcg::LocalOptimization<Mesh> session(mesh, &parameters);
    session.Init<Collapse>();
    const int start = mesh.fn;
    constexpr int collapses_per_report = 10000; // by number, not by time: the steps must not depend on the machine
    session.SetTargetSimplices(faces);
    session.SetTargetOperations(collapses_per_report);
    while (mesh.fn > faces && session.DoOptimization())
        report(progress, static_cast<int>(100.0 * (start - mesh.fn) / (start - faces)), "Simplifying");
    session.Finalize<Collapse>();
    if (mesh.fn > faces)
        throw Error("The collapses end at " + std::to_string(mesh.fn) + " faces, so the mesh cannot be simplified to " +
                    std::to_string(faces) + ". Remove a smaller part.");
    return to_surface(mesh);
}

} // namespace vcg_ext
