// SPDX-License-Identifier: GPL-3.0-or-later
#include "stream.h"

#include <numeric>
#include <sodium.h>
#include <utility>

namespace vcg_ext {

Stream::Stream(const std::array<unsigned char, 32>& subkey) : subkey_(subkey), used_(block_.size()) {}

Stream::~Stream()
{
    sodium_memzero(subkey_.data(), subkey_.size());
    sodium_memzero(block_.data(), block_.size());
}

void Stream::refill()
{
    constexpr unsigned char nonce[crypto_stream_chacha20_NONCEBYTES] = {};
    block_.fill(0);
    crypto_stream_chacha20_xor_ic(block_.data(), block_.data(), block_.size(), nonce, counter_, subkey_.data());
    counter_ += block_.size() / 64; // ChaCha20 counts blocks of 64 bytes
    used_ = 0;
}

std::uint64_t Stream::next()
{
    if (used_ == block_.size())
        refill();
    std::uint64_t value = 0;
    for (int byte = 7; byte >= 0; --byte)
        value = value << 8 | block_[used_ + byte];
    used_ += 8;
    return value;
}

std::uint64_t Stream::below(std::uint64_t n)
{
    const std::uint64_t rest = (UINT64_MAX % n + 1) % n; // 2^64 mod n: so many values too many
    for (;;) {
        const std::uint64_t value = next();
        if (value <= UINT64_MAX - rest)
            return value % n;
    }
}

std::vector<int> Stream::permutation(int n)
{
    std::vector<int> order(n);
    std::iota(order.begin(), order.end(), 0);
    for (int i = n - 1; i > 0; --i)
        std::swap(order[i], order[below(i + 1)]);
    return order;
}

} // namespace vcg_ext
