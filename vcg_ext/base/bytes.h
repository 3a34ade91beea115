// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "error.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace vcg_ext {

/// The unsigned integer as wide as a number.
template <class Number>
using BitsOf =
    std::conditional_t<sizeof(Number) == 1, std::uint8_t,
                       std::conditional_t<sizeof(Number) == 2, std::uint16_t,
                                          std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint64_t>>>;

/// Numbers to bytes, little-endian on every machine.
class ByteWriter {
public:
    template <class Number>
    void put(Number number)
    {
        BitsOf<Number> bits;
        std::memcpy(&bits, &number, sizeof bits);
        for (std::size_t i = 0; i < sizeof bits; ++i)
            bytes_ += static_cast<char>(static_cast<unsigned char>(static_cast<std::uint64_t>(bits) >> 8 * i));
    }

    [[nodiscard]] const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
};

/// And back.
class ByteReader {
public:
    /// \param bytes must outlive it
    explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

    /// \throw Error where no bytes are left, or they are no finite number
    template <class Number>
    Number get()
    {
        BitsOf<Number> bits = 0;
        if (left() < sizeof bits)
            throw Error("The data end too early.");
        for (std::size_t i = 0; i < sizeof bits; ++i) {
            const auto byte = static_cast<std::uint64_t>(static_cast<unsigned char>(bytes_[at_++]));
            bits = static_cast<BitsOf<Number>>(bits | byte << 8 * i);
        }
        Number number;
        std::memcpy(&number, &bits, sizeof bits);
        if constexpr (std::is_floating_point_v<Number>)
            if (!std::isfinite(number))
                throw Error("One of the numbers is not finite.");
        return number;
    }

    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

} // namespace vcg_ext
