// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/progress.h"
#include "../key/key.h"
#include "options.h"
#include "report.h"

namespace vcg_ext {

/// Reads a message with the key and the unmarked original: cut, stretched, mirrored, heavily smoothed as the surface
/// may be. It is laid on the original first, by shape alone; then the carriers are read where the original has them,
/// and Waves from the field by which the surface lies off it. What is not there is no evidence either way.
///
/// Where that says nothing of a copy, the key alone is tried, for a fifth of the doubt, and the verdict says so. Where
/// the surface is no copy of this original, the verdict says so, with the figures, and nothing is read.
///
/// \throw Error as detect(); where the original carries a mark of this key itself, so that what is found would prove
///              nothing
[[nodiscard]] DetectReport detect_with_original(const Surface& surface, const Surface& original, const Key& key,
                                                const DetectOptions& options, const Progress& progress = {});

} // namespace vcg_ext
