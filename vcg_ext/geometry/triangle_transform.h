// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "wave_columns.h"

#include <algorithm>

namespace vcg_ext {

/// Greatest squared phase between a triangle's centroid and a corner. \param largest of all |q|
[[nodiscard]] inline double squared_spread(const Points& points, const Triangle& t, double largest)
{
    const Point centre = (points[t[0]] + points[t[1]] + points[t[2]]) / 3;
    return largest * largest *
           std::max({(points[t[0]] - centre).squaredNorm(), (points[t[1]] - centre).squaredNorm(),
                     (points[t[2]] - centre).squaredNorm()});
}

/// Adds (q . n) times the integral of exp(i q . x) over a triangle, n its unit normal, for all waves: by divided
/// differences where its phases lie apart, by series about the centroid where they are close.
void add_triangle(const WaveColumns& q, const Points& points, const Triangle& t, double spread, WaveSums& sums);

} // namespace vcg_ext
