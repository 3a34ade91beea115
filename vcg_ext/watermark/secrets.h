// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../carrier/reading.h"
#include "../key/key.h"
#include "../payload/message.h"

namespace vcg_ext {

/// The secret bits that are XOR-ed into what the carriers hold. So on a mesh without this key's mark each bit that is
/// read matches by even chance, whatever the carriers say: all probabilities rest on this.
/// \param secret whose bits: layers have masks of their own, so they are independent witnesses
[[nodiscard]] Bits bit_mask(const Key& key, const std::string& secret, int count);

/// `bits` with the mask put on, or taken off. \pre as long as each other
[[nodiscard]] Bits masked(Bits bits, const Bits& mask);

/// The soft values with the mask lifted: positive where the coded bit is 1.
[[nodiscard]] std::vector<double> unmasked(std::vector<double> soft, const Bits& mask);

/// What soft values say: 1 where they are positive.
[[nodiscard]] Bits hard_bits(const std::vector<double>& soft);

} // namespace vcg_ext
