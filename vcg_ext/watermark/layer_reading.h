// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../carrier/reading.h"
#include "../method/methods.h"

#include <functional>

namespace vcg_ext {

/// What one method read of a surface, and the mask of its bits.
struct LayerReading {
    Method method{};
    Readings readings;
    Bits mask;
};

/// What one layer reads of a surface by a plan.
using LayerReader = std::function<Readings(const MethodRow& method, const Plan& plan)>;

} // namespace vcg_ext
