// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// What faces have at their corners beside positions, as numbers: texture coordinates, colours.
struct CornerValues {
    int channels = 0;
    std::vector<double> values; ///< corner by corner: those of corner k of face f begin at (3 f + k) * channels

    [[nodiscard]] const double* at(int face, int corner) const
    {
        return values.data() + static_cast<std::size_t>(3 * face + corner) * channels;
    }
    [[nodiscard]] double* at(int face, int corner)
    {
        return values.data() + static_cast<std::size_t>(3 * face + corner) * channels;
    }
};

struct CarriedValues {
    CornerValues values;
    /// What is left of stretching, at which 95 % of the faces lie: of what a face shows, the largest factor by which a
    /// length grew or shrank between cover and moved surface. 1: none.
    double stretch = 1;
};

/// The corners' values after vertices have slid along their surface: what the cover shows at the place nearest to where
/// the vertex is now. So a picture on the surface stays where it was, and only the mesh under it moves.
///
/// Each corner takes the values of its own chart (faces that share them at the edges between). A vertex on a seam between
/// charts takes, on all sides, the values of one place on the seam, so the picture stays closed; one where three charts
/// meet keeps its own.
///
/// \param moved positions of the cover's vertices, those at one position still at one
[[nodiscard]] CarriedValues carried_values(const Surface& cover, const CornerValues& values, const Points& moved);

/// Per vertex whether its position shows more than one set of values, as along the seams of a texture.
[[nodiscard]] std::vector<char> on_seams(const Surface& cover, const CornerValues& values);

} // namespace vcg_ext
