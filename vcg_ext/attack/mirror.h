// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// The mirror image in the plane x = 0; faces are turned round, so what was outside stays outside.
[[nodiscard]] Surface mirror(const Surface& surface);

} // namespace vcg_ext
