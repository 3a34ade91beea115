// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

#include <cstdint>

namespace vcg_ext {

/// A random linear map `I + E` about the centre of the bounding box. The nine entries of E are drawn uniformly and
/// scaled so that its largest singular value is `amount`: the largest stretch, squeeze or shear of any vector, relative
/// to its length. Gives the new positions.
[[nodiscard]] Points affine(const Points& points, double amount, std::uint64_t seed);

} // namespace vcg_ext
