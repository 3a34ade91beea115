// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vcg_ext {

/// One bit an element, 0 or 1. Bytes count from their highest bit.
using Bits = std::vector<std::uint8_t>;

/// Reads `bits:0110...`, `hex:C0FFEE`, or any other text as its UTF-8 bytes.
///
/// \throw Error where it is empty, or has another digit than it may
[[nodiscard]] Bits parse_message(std::string_view text);

/// `message` filled up with zeros to `count` bits.
///
/// \throw Error where it is longer; the spare bits of a last hex digit, if zero, may be dropped
[[nodiscard]] Bits pad_message(Bits message, int count);

/// The bits as the text that parse_message() takes: plain where they are printable UTF-8 (trailing zero bytes dropped),
/// else `hex:...`, the last digit filled up with zeros.
[[nodiscard]] std::string format_message(const Bits& bits);

/// The bits as 0s and 1s.
[[nodiscard]] std::string bit_string(const Bits& bits);

} // namespace vcg_ext
