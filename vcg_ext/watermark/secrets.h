// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../carrier/reading.h"
#include "../key/key.h"
#include "../payload/message.h"

namespace vcg_ext {

/// The secret bits that are XOR-ed into what the carriers hold. So on a mesh without this key's mark each bit that is
/// read matches by even chance, whatever the carriers say: all probabilities rest on this.
[[nodiscard]] Bits bit_mask(const Key& key, int count);

/// `bits` with the mask put on, or taken off. \pre as long as each other
[[nodiscard]] Bits masked(Bits bits, const Bits& mask);

/// The soft values of a reading with the mask lifted: positive where the message's bit is 1.
[[nodiscard]] std::vector<double> unmasked(const Reading& reading, const Bits& mask);

/// What the soft values say: 1 where they are positive.
[[nodiscard]] Bits hard_bits(const Reading& reading, const Bits& mask);

} // namespace vcg_ext
