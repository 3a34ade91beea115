// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "vcg_ext/base/surface.h"

#include <string>

/// One of the OFF, PLY and STL meshes that set-up unpacked from Debian's libcgal-demo, such as "bunny00.off"; polygons
/// are cut to triangles. \throw std::runtime_error where it cannot be read
[[nodiscard]] vcg_ext::Surface load(const std::string& name);

/// The same of any file.
[[nodiscard]] vcg_ext::Surface load_file(const std::string& path);

/// The surface as it comes back from a binary STL file: floats, and no vertex shared by two faces.
[[nodiscard]] vcg_ext::Surface through_stl(const vcg_ext::Surface& surface);
