// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "vcg_ext/base/surface.h"

namespace shapes {

/// The box [0, a] x [0, b] x [0, c] of 12 triangles.
vcg_ext::Surface box(double a, double b, double c);

/// The unit sphere: an icosahedron, each of its faces cut into four `levels` times, pushed out to the radius.
vcg_ext::Surface sphere(int levels);

/// Equilateral triangles of edge `edge` over about [0, width] x [0, height], z = 0.
vcg_ext::Surface triangular_grid(double width, double height, double edge);

/// `surface` scaled, then rotated by `angle` about `axis`, then shifted.
vcg_ext::Surface moved(vcg_ext::Surface surface, double scale, double angle, const vcg_ext::Point& axis,
                       const vcg_ext::Point& shift);

/// The same surface with its vertices, its faces and the faces' first corners in another order, drawn from `seed`.
vcg_ext::Surface renumbered(const vcg_ext::Surface& surface, unsigned seed);

} // namespace shapes
