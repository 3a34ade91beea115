// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "message.h"

#include <cstdint>
#include <vector>

namespace vcg_ext {

/// A linear block code of any length up to 1024: a polar code whose frozen bits are parity checks of the message bits
/// before them (Arikan, "From sequential decoding to channel polarization and back again", 2019: PAC codes).
///
/// u = message and parity bits, x = u F^m with F = (1 0, 1 1), natural order. Plain polar codes of such lengths have
/// many words of least weight; the parity checks and a choice of rows between Reed-Muller's and the most reliable thin
/// them out. Where the length is no power of two, the rest of x is shortened, or punctured at rates up to 1/5. All
/// choices are by measurement (tests/benchmark/code_rates) and made with integers, so all machines agree.
struct PolarCode {
    int bits = 0;                    ///< message bits
    int levels = 0;                  ///< m: 2^m is the least power of two that has room for the carriers
    std::vector<std::uint8_t> holds; ///< per index of u: whether a message bit is there
    std::vector<std::uint8_t> zero;  ///< per index of u: whether it is 0, as is x there, which has no carrier
    std::vector<int> place;          ///< per carrier its index of x
};

/// \param bits message bits, 1 to `carriers`  \param carriers 1 to 1024  \throw Error where they are outside
[[nodiscard]] PolarCode polar_code(int bits, int carriers);

/// The message's word, one bit a carrier. \pre as many bits as the code has
[[nodiscard]] Bits polar_encode(const PolarCode& code, const Bits& message);

/// The message whose word agrees best with the soft values, of those that successive-cancellation list decoding finds
/// (Tal and Vardy 2015): the best `list` beginnings of u are followed from bit to bit.
///
/// With the min-sum rule a path's cost is exactly the weight of the carriers in which its word differs from the signs,
/// so the last choice is maximum likelihood among the list. Only sums, differences and comparisons of doubles; ties go
/// to the lower index: the same answer on every machine.
///
/// \param soft one a carrier, positive for 1, of any scale; 0 (or what is not a number) is an erasure
/// \param list 1 to 1024; time is proportional to it
[[nodiscard]] Bits polar_decode(const PolarCode& code, const std::vector<double>& soft, int list = 32);

} // namespace vcg_ext
