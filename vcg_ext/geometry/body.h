// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

#include <optional>
#include <string>

namespace vcg_ext {

/// The part of a surface that carries a mark, mended so far that what tools and file formats do to single triangles
/// changes nothing: embedding and detection both begin with it.
///
/// - Every position occurs once (see weld()), and vertices of the boundary that lie within 3e-4 of the body's size of
///   each other are one: seams are closed.
/// - Where neighbours run round in opposite ways, the way of the greater area is taken throughout their component.
/// - Loose pieces are left out: those below 1 % of the area, as scanners leave them, unless they are half of it
///   together.
struct Body {
    Surface surface;                 ///< sites, and the faces over them
    std::vector<int> site_of_vertex; ///< per vertex of the surface as it came; -1: it is no part of the body
    int pieces = 0;                  ///< connected parts of the whole surface
    int loose_pieces = 0;            ///< of them left out
    bool closed = false;             ///< whether the faces bounded a solid before any mending
};

/// \param which how an error names it  \throw Error as check_surface()
[[nodiscard]] Body body_of(Surface surface, const char* which = "mesh");

/// The sites of body_of() a surface with the faces that `before` was made of and vertices elsewhere. Empty where faces
/// alone do not tell that the two bodies differ by positions only.
[[nodiscard]] std::optional<Points> sites_moved(const Body& before, const Points& moved);

/// "30 of the 31 separate pieces of the mesh are below 1 % of its area, and carry nothing."; empty where none are.
[[nodiscard]] std::string about_loose_pieces(const Body& body);

/// The vertices of the surface as it came, were the body's sites at `sites`: each moves as its site does, so a seam that
/// was open stays as wide as it was.
[[nodiscard]] Points with_sites_at(const Body& body, const Points& original, const Points& sites);

} // namespace vcg_ext
