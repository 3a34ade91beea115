// SPDX-License-Identifier: GPL-3.0-or-later
#include "resample.h"

#include "../base/weld.h"
#include "../geometry/size.h"
#include "remesh.h"
#include "simplify.h"

#include <cmath>
#include <cstdlib>

namespace vcg_ext {

namespace {

constexpr int remesh_iterations = 5;

/// The edge of equilateral triangles, six at a vertex, of which `area` takes `vertices`.
double edge_for(double area, int vertices)
{
    return std::sqrt(2 * area / (std::sqrt(3.0) * vertices));
}

/// Collapses what is too many, as far as that goes. A collapse takes one vertex with two faces, or at a border with
/// one: so it is done in several steps.
Surface down_to(Surface surface, int vertices, const Progress& progress)
{
    for (;;) {
        const int excess = static_cast<int>(surface.points.size()) - vertices;
        const int faces = static_cast<int>(surface.triangles.size());
        if (excess <= 0 || faces <= excess)
            return surface;
        Surface fewer = weld(simplify(surface, faces - excess, progress)).surface;
        if (fewer.triangles.empty() || fewer.points.size() == surface.points.size())
            return surface;
        surface = std::move(fewer);
    }
}

} // namespace

Surface resample(const Surface& surface, int vertices, const Progress& progress)
{
    if (vertices < 4)
        throw Error("That would leave " + std::to_string(vertices) +
                    " vertices, and a surface of fewer than 4 holds nothing. Keep a larger part.");
    // Remeshing gives up to 3 % fewer than evenly spread ones, or more where creases want them: one try is mostly enough.
    double length = 0.97 * edge_for(surface_area(surface), vertices);
    constexpr double most_to_collapse = 1.15;
    constexpr int tries = 8;
    for (int i = 0; i < tries; ++i) {
        Surface even = remesh(surface, length, remesh_iterations,
                              within(progress, 100 * i / tries, 100 * (i + 1) / tries, "Resampling"));
        if (even.points.empty())
            break;
        const double ratio = static_cast<double>(even.points.size()) / vertices;
        if (ratio >= 1 && (ratio <= most_to_collapse || i >= tries / 2))
            even = down_to(std::move(even), vertices, progress);
        if (std::abs(static_cast<double>(even.points.size()) - vertices) <= 0.01 * vertices)
            return even;
        length *= std::sqrt(ratio / 1.04); // aim a little above, for collapses can only take away
    }
    throw Error("The surface cannot be resampled to " + std::to_string(vertices) +
                " vertices: its creases and borders fix another number. Keep a larger part.");
}

} // namespace vcg_ext
