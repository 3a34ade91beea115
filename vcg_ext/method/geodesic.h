// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../placement/cover.h"
#include "copy.h"
#include "scalar.h"

namespace vcg_ext {

/// The method of geodesic distances (chapter 4): strips about a point that the key chose, and front placement; see
/// MethodRow.
[[nodiscard]] Plan plan_geodesic(const Key& key, const CarrierOptions& options);
[[nodiscard]] MarkFrame find_geodesic(const Surface& surface, const Plan& plan);
[[nodiscard]] Readings read_geodesic(const Surface& surface, const Plan& plan, const MarkFrame& frame);

/// With the original at hand: distances are those of the feet on the original, so ways that were cut off still count.
[[nodiscard]] MarkFrame find_geodesic_copy(const Copy& copy, const Plan& plan);
[[nodiscard]] Readings read_geodesic_copy(const Copy& copy, const Plan& plan, const MarkFrame& frame);

[[nodiscard]] Marking embed_geodesic(const Cover& cover, const Plan& plan, const Bits& coded,
                                     const PlacementOptions& options, const Progress& progress);

} // namespace vcg_ext
