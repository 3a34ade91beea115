// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// Rounds every coordinate to the nearest of `2^bits` evenly spaced values between the axis' smallest and largest, as a
/// file format with that many bits would. Gives the new positions.
[[nodiscard]] Points quantize(const Points& points, int bits);

} // namespace vcg_ext
