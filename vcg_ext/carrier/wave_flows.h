// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "wave_body.h"

namespace vcg_ext {

/// Unit normals of the body's sites, by area, outward.
[[nodiscard]] Points site_normals(const WaveBody& body);

/// How processing moves a surface along its normals, each with RMS 1 over the sites: (a) by the mean curvature
/// (cotangent weights, at most 1 over the mean edge), as whatever cuts corners does; (b) by the normal part of the
/// umbrella vector (mean of the neighbours less the vertex), as smoothing with uniform weights does.
[[nodiscard]] std::vector<std::vector<double>> processing_flows(const WaveBody& body, const Points& normals);

/// Powers of the umbrella operator L (mean of the neighbours less the vertex) on the sites' positions: L x to L^n x.
[[nodiscard]] std::vector<Points> umbrella_powers(const WaveBody& body, int n);

/// The body before smoothing (1 + lambda L)^k, as far as the binomial series of (1 + lambda L)^-k says that has as many
/// terms as there are powers: c_j = -c_(j-1) (s + (j - 1) lambda) / j, s = lambda k. Sites and apexes.
[[nodiscard]] Points before_smoothing(const WaveBody& body, const std::vector<Points>& powers, double lambda, double s);

} // namespace vcg_ext
