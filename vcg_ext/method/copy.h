// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../geometry/registration.h"

namespace vcg_ext {

/// A surface that was registered to the original that it is a copy of. Both are welded.
struct Copy {
    const Surface& original;
    const Surface& surface;
    const Registrar& registrar; ///< of the original as solid_topology() sews and orients it
    Registration registration;
};

/// Where its vertices stand on the original, laid on it: no feet where that is missing.
[[nodiscard]] std::vector<Foot> feet_on_original(const Copy& copy, const Surface& laid);

/// The copy laid on its original: in the original's place, at its size, its faces looking the same way.
[[nodiscard]] Surface laid_on_original(const Copy& copy);

} // namespace vcg_ext
