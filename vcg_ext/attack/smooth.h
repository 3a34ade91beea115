// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/error.h"
#include "../base/progress.h"
#include "../base/surface.h"

namespace vcg_ext {

/// Laplacian smoothing with uniform weights: in every step each vertex goes the part `lambda` of the way to the mean of
/// its neighbours, all at once. At a border too, where the surface therefore shrinks. Gives the new positions.
[[nodiscard]] Points smooth(const Surface& surface, double lambda, int iterations, const Progress& progress = {});

/// Smoothing without shrinking (Taubin 1995): each step by `lambda` towards the neighbours' mean is followed by one of
/// 1.06 lambda away from it. Gives the new positions.
[[nodiscard]] Points smooth_by_taubin(const Surface& surface, double lambda, int iterations,
                                      const Progress& progress = {});

} // namespace vcg_ext
