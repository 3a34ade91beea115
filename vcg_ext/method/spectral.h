// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/progress.h"
#include "../carrier/reading.h"
#include "../payload/message.h"
#include "../placement/cover.h"
#include "copy.h"
#include "plan.h"

namespace vcg_ext {

/// The method of spectral coefficients (chapter 3): equal-area patches, the shape of their high bands; see MethodRow.
[[nodiscard]] Plan plan_spectral(const Key& key, const CarrierOptions& options);
[[nodiscard]] MarkFrame find_spectral(const Surface& surface, const Plan& plan);

/// Four ways, in which axis 1 and axis 2 point along or against the frame's. Blind is that of the third moments, as in
/// the thesis; along an axis on which the body is mirror-symmetric, and so has none, the spare patches decide: they
/// carry 0, 1, 0, 1, ...
[[nodiscard]] Readings read_spectral(const Surface& surface, const Plan& plan, const MarkFrame& frame);

/// With the original at hand: the patches are the original's, and its axes leave no choice.
[[nodiscard]] MarkFrame find_spectral_copy(const Copy& copy, const Plan& plan);
[[nodiscard]] Readings read_spectral_copy(const Copy& copy, const Plan& plan, const MarkFrame& frame);

/// \throw DoesNotFit where patches are too small or too few
[[nodiscard]] Marking embed_spectral(const Cover& cover, const Plan& plan, const Bits& coded,
                                     const PlacementOptions& options, const Progress& progress);

} // namespace vcg_ext
