// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/error.h"
#include "../base/progress.h"
#include "../base/surface.h"

#include <vector>

namespace vcg_ext {

/// Absolute mean curvature per vertex, by vcglib after Meyer et al. 2003 (cotangents over the mixed area); 0 where a
/// vertex has no area around it. The unit is 1 / length.
[[nodiscard]] std::vector<double> mean_curvature(const Surface& surface);

/// Mesh structural distortion measure (Lavoue et al. 2006): how far the local statistics of curvature differ. 0 for
/// equal meshes, about 1 where they have nothing in common. S reaches 2 where one's curvature falls as the other's
/// rises: so at most 2.4^(1/3) = 1.34.
///
/// For each vertex (of more than a million, for at least 524,288 evenly chosen ones), the window is what is connected
/// to it within a sphere of radius 0.005 of the longest side of the bounding box: vertices, and the places where edges
/// leave the sphere, with the curvature interpolated. Of mean, standard deviation and covariance of the window's
/// curvatures on both meshes,
///
///     L = |m - m'| / (max(m, m') + c)    C = |s - s'| / (max(s, s') + c)    S = |s s' - cov| / (s s' + c^2)
///     local = (0.4 L^3 + 0.4 C^3 + 0.2 S^3)^(1/3)        MSDM = (mean of local^3)^(1/3)
///
/// c = 0.1 over the diagonal, a curvature too small to see, keeps the rounding of flat regions out; the paper has none.
///
/// \param same_faces both surfaces have the same faces, and vertices of one number belong together. Otherwise the
///                   windows are the measured mesh's and the reference's curvatures are taken at the nearest points,
///                   then the other way round; the result is the mean of both, as MSDM2 (Lavoue 2011) has it.
/// \pre welded surfaces with an area
/// \throw Cancelled where `progress` returned false
[[nodiscard]] double msdm(const Surface& reference, const Surface& measured, bool same_faces,
                          const Progress& progress = {});

} // namespace vcg_ext
