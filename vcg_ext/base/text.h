// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace vcg_ext {

/// A number as messages have it: six digits, more where these would read back as another number; always with a decimal
/// point. 0.1 is "0.1", 1e-7 is "1e-07".
[[nodiscard]] std::string text(double number);

} // namespace vcg_ext
