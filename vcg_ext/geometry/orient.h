// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// Turns the faces of each component (joined at edges of two faces) the way that most of its area runs.
void orient_alike(Surface& surface);

} // namespace vcg_ext
