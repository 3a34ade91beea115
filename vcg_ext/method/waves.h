// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/progress.h"
#include "../carrier/reading.h"
#include "../payload/message.h"
#include "../placement/cover.h"
#include "certificate.h"
#include "copy.h"
#include "plan.h"

namespace vcg_ext {

/// The method of waves: each bit in one Fourier coefficient of the solid, by quantization index modulation; see
/// MethodRow.
[[nodiscard]] Plan plan_waves(const Key& key, const CarrierOptions& options);
[[nodiscard]] MarkFrame find_waves(const Surface& surface, const Plan& plan);

/// Strengths from 5e-6 to 2e-3 are tried, those near the usual one with the most weight.
[[nodiscard]] Readings read_by_waves(const Surface& surface, const Plan& plan, const MarkFrame& frame);

/// With the original at hand: the field by which a copy lies off it, demodulated (carrier/demodulation.h).
[[nodiscard]] MarkFrame find_wave_copy(const Copy& copy, const Plan& plan);
[[nodiscard]] Readings read_wave_copy(const Copy& copy, const Plan& plan, const MarkFrame& frame);

/// The same by what a certificate has of the original: patches stand for samples, and smoothing cannot be simulated.
void certify_waves(const Surface& original, const Plan& plan, Certificate& certificate);
[[nodiscard]] Readings read_certified_waves(const CertifiedCopy& copy, const Plan& plan);

[[nodiscard]] Marking embed_by_waves(const Cover& cover, const Plan& plan, const Bits& coded,
                                     const PlacementOptions& options, const Progress& progress);

} // namespace vcg_ext
