// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "message.h"

#include <string>
#include <string_view>
#include <vector>

namespace vcg_ext {

/// How a message was written, which is also how it is shown.
///
/// Text and hex are two ways to write the same bits: shown as text where they are printable UTF-8, else as hex. An id
/// is another message than a text or hex of its 32 bits: it has a code of its own (code.h), so the detector knows it
/// for an id without a bit spent on that. Raw bits are not coded at all.
enum class Kind { Text, Hex, Id, Bits };

/// A message as the user wrote it.
struct Message {
    Kind kind = Kind::Text;
    Bits bits;        ///< 8 a byte of the text, 4 a hex digit, 32 for an id, 1 a raw bit
    std::string text; ///< as written, with its prefix
};

/// Reads `id:17` (0 to 4294967295), `hex:C0FFEE`, `bits:0110...`, or any other text as its UTF-8 bytes.
///
/// One letter can be spelled in several ways in Unicode: the host brings a text into NFC before it comes here (Qt:
/// `QString::normalized`), at embedding and at detection.
///
/// \throw Error where it is empty, has another digit than it may, or begins with `file:`
[[nodiscard]] Message read_message(std::string_view text);

/// What read_message() takes for these bits: `id:17` of 32 bits; `bits:0110...`; else the text without the zero bytes
/// at its end where it is printable UTF-8 and has none of the prefixes, else `hex:...`.
[[nodiscard]] std::string show_message(const Bits& bits, Kind kind);

/// How long the message is, in the user's own terms: "13 letters need 104 bits", "5 hexadecimal digits need 20 bits",
/// "1 letter (2 bytes) needs 16 bits".
[[nodiscard]] std::string need(const Message& message);

/// The messages in the contents of a file, one a line: LF or CRLF, a UTF-8 byte order mark skipped, empty lines too.
///
/// \throw Error where there is none, more than a million, or one that read_message() refuses (names its line)
[[nodiscard]] std::vector<Message> read_candidates(std::string_view contents);

} // namespace vcg_ext
