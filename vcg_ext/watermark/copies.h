// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../geometry/registration.h"
#include "detect.h"

namespace vcg_ext {

/// What reads a surface that was registered to its original; both outlive it.
using CopyReader = std::function<LayerReader(const Surface& surface, const Registration& registration)>;

/// Looks at a surface, and where that gives nothing at its pieces, as copies of one original: registers each, and reads
/// those that are copies. Where a copy says nothing either, the key alone is tried, for a fifth of the doubt.
[[nodiscard]] DetectReport detect_copies(const Surface& surface, const Registrar& registrar, const CopyReader& reader,
                                         const Key& key, const DetectOptions& options, const Progress& progress);

} // namespace vcg_ext
