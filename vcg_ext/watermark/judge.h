// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../carrier/reading.h"
#include "../payload/message.h"

#include <optional>

namespace vcg_ext {

/// What a surface's readings come to, the mask lifted.
struct Judgement {
    int way = 0;                           ///< the one that was taken
    Bits bits;                             ///< as it reads them
    std::optional<double> detection_ratio; ///< with an expected message only, as the two that follow
    std::optional<double> p_value;
    std::optional<bool> present;
};

/// Takes the way that matches the expected message best, or the blind one, and says what the match is worth.
/// \param expected as long as the mask
[[nodiscard]] Judgement judge(const Readings& readings, const Bits& mask, const std::optional<Bits>& expected);

} // namespace vcg_ext
