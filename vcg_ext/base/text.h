// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>

namespace vcg_ext {

/// A number as messages have it: six digits, more where these would read back as another number; always with a decimal
/// point. 0.1 is "0.1", 1e-7 is "1e-07".
[[nodiscard]] std::string text(double number);

/// A probability as verdicts have it, rounded up to a power of ten so that it stays a bound: "p 1e-6".
[[nodiscard]] std::string chance(double log10_p);

/// A part, such as 0.17, in whole hundredths: "17 %".
[[nodiscard]] std::string percent(double part);

[[nodiscard]] bool starts_with(std::string_view text, std::string_view prefix);

} // namespace vcg_ext
