#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <future>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace vcg_ext {

/// A keyed stream of integer draws. Every draw is defined on integers, so all platforms agree to the bit.
///
/// The bytes are ChaCha20 under the sub-key, nonce 0; wiped when the stream ends.
class Stream {
public:
    explicit Stream(const std::array<unsigned char, 32>& subkey);
    ~Stream();
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;

    /// The next eight bytes, little-endian.
    std::uint64_t next();

    /// Uniform in [0, n), by rejection. \pre n > 0
    std::uint64_t below(std::uint64_t n);

    /// Uniform permutation of 0 .. n-1 by Fisher-Yates on below().
    std::vector<int> permutation(int n);

private:
    void refill();

    std::array<unsigned char, 32> subkey_;
    std::array<unsigned char, 512> block_{};
    std::size_t used_ = 0;
    std::uint32_t counter_ = 0;
};

/// The 256-bit secret that all draws come from, wiped from memory when it ends.
///
/// A passphrase goes through Argon2id (libsodium, 2 passes, 64 MiB, a fixed salt: detection is blind, so there is no
/// place to keep a random one). Deriving costs some 0.1 s: do it once and pass the key on. It runs in the background,
/// so that the mesh can be read meanwhile; the first stream() waits for it.
class Key {
public:
    /// \param secret the passphrase's bytes  \throw Error where it is empty
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
