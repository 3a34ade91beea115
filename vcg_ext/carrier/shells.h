#pragma once
#include "../base/surface.h"
#include "carriers.h"

namespace vcg_ext {

/// Vertex norms about the surface's own centre, and the shells that cut their range ((5.1)-(5.6)).
struct Shells {
    Point centre;              ///< (5.1) with the normaliser put right: sum A(v) v / sum A(v)
    std::vector<double> norms; ///< |v - centre|
    double minimum = 0;
    double maximum = 0;
    Carriers carriers;
};

/// |v - centre| of every vertex.
[[nodiscard]] std::vector<double> norms(const Points& points, const Point& centre);

/// \param trim part of the range of norms that is cut off at both ends, eps of (5.2)
/// \throw Error where no face has an area, or all norms are the same
[[nodiscard]] Shells shells(const Points& points, const std::vector<Triangle>& triangles, double trim, int count);

} // namespace vcg_ext
