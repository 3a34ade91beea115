// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/bytes.h"
#include "likeness.h"

namespace vcg_ext {

/// Of the surface around each of some points: its area, and how far it lies along the point's normal on average. Both
/// are weighted as (1 - d^2 / r^2)^2 up to a distance of r, so they average what is finer than that, as noise is; faces
/// that look the other way do not count.
struct LocalMeans {
    std::vector<double> masses;
    std::vector<double> offsets; ///< 0 where there is no mass
};

/// Integrals over the faces, cut up where they are large against r: they hardly depend on how the surface is meshed.
[[nodiscard]] LocalMeans local_means(const Points& points, const Points& normals, double r, const Surface& surface);

/// The r of an impression's patches, in sizes, and the standard deviation along the surface of what they weigh there.
constexpr double mean_radius = 0.11;
constexpr double mean_spread = mean_radius / 2.8284271247461903;

/// What some points keep of a surface, in some 25 kB: enough to lay a copy of it in its place, and to see by how much
/// the copy lies off it. In the surface's own coordinates and unit, as `write()` stores them.
struct Impression {
    Likeness likeness;         ///< with the features of the first points
    Points points;             ///< as far from each other as can be
    Points normals;            ///< of the faces there, outward
    std::vector<double> areas; ///< of what is nearest to each point
    LocalMeans means;
};

/// \param surface mended, see body_of()  \throw Error where it has no area
[[nodiscard]] Impression impression_of(const Surface& surface, int count = 1500);

/// A surface of overlapping hexagons, one about each point and square to its normal.
[[nodiscard]] Surface scales_of(const Impression& impression);

void write(ByteWriter& writer, const Impression& impression);

/// \throw Error where the bytes are no impression
[[nodiscard]] Impression read_impression(ByteReader& reader);

} // namespace vcg_ext
