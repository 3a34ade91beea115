// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "vcg_ext/base/surface.h"

/// Whether every edge has two faces that run along it in opposite directions, and the faces at every vertex make one
/// fan.
[[nodiscard]] bool is_closed_manifold(const vcg_ext::Surface& surface);

/// Vertices minus edges plus faces: two a component, less two a handle.
[[nodiscard]] int euler_characteristic(const vcg_ext::Surface& surface);

/// Each face with three vertices of its own, as STL has it.
[[nodiscard]] vcg_ext::Surface soup(const vcg_ext::Surface& surface);

/// `first` and `second` side by side in one surface.
[[nodiscard]] vcg_ext::Surface joined(vcg_ext::Surface first, const vcg_ext::Surface& second);
