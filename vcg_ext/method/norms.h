// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../placement/cover.h"
#include "certificate.h"
#include "copy.h"
#include "scalar.h"

namespace vcg_ext {

/// The methods of vertex norms (chapter 5 and Cho): shells of the distance to the centre. What they share but the
/// placement; see MethodRow.
[[nodiscard]] Plan plan_norms(const Key& key, const CarrierOptions& options);
[[nodiscard]] MarkFrame find_norms(const Surface& surface, const Plan& plan);
[[nodiscard]] Readings read_norms(const Surface& surface, const Plan& plan, const MarkFrame& frame);

/// With the original at hand: its shells, and what is left of each beside the same part of the original. With a
/// certificate: its shells alone.
[[nodiscard]] Readings read_norms_copy(const Copy& copy, const Plan& plan, const MarkFrame& frame);
void certify_norms(const Surface& original, const Plan& plan, Certificate& certificate);
[[nodiscard]] Readings read_certified_norms(const CertifiedCopy& copy, const Plan& plan);

/// How a vertex gets to its sphere.
enum class Radial {
    Sphere,    ///< where that is least seen, by Levenberg-Marquardt (thesis 5.5)
    Selective, ///< where a quadric says so (thesis 5.4)
    Straight   ///< along the ray from the centre (Cho et al.)
};

template <Radial placement>
[[nodiscard]] Marking embed_norms(const Cover& cover, const Plan& plan, const Bits& coded,
                                  const PlacementOptions& options, const Progress& progress);

} // namespace vcg_ext
