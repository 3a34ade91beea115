// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "stream.h"

#include <array>
#include <future>
#include <memory>
#include <string_view>

namespace vcg_ext {

/// The 256-bit secret that all draws come from, wiped from memory when it ends.
///
/// A passphrase goes through Argon2id (libsodium, 2 passes, 64 MiB, a fixed salt: detection is blind, so there is no
/// place to keep a random one). Deriving costs some 0.1 s: do it once and pass the key on. It runs in the background,
/// so that the mesh can be read meanwhile; the first stream() waits for it.
class Key {
public:
    /// \param secret the passphrase's bytes
    /// \throw Error where it is empty
    explicit Key(std::string_view secret);

    /// Independent draws for one purpose, such as "carrier-order": keyed BLAKE2b of the purpose gives the sub-key.
    /// \throw Error where there is not the memory to derive the key
    [[nodiscard]] Stream stream(std::string_view purpose) const;

private:
    struct Master {
        std::array<unsigned char, 32> bytes;
        ~Master();
    };
    std::shared_future<std::unique_ptr<const Master>> master_;
};

/// A key from what a user typed: a passphrase, or `file:PATH` (the file's bytes), or `env:NAME`.
///
/// \throw Error where the text, the file or the variable is empty or missing. The text itself is never part of it.
[[nodiscard]] Key key_from_text(std::string_view text);

} // namespace vcg_ext
