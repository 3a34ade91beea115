// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace vcg_ext {

constexpr double pi = 3.14159265358979323846;

} // namespace vcg_ext
