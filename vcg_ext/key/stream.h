// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
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

    /// Uniform in [0, n), by rejection.
    /// \pre n > 0
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

} // namespace vcg_ext
