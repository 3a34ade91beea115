// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../geometry/registration.h"

namespace vcg_ext {

/// A welded surface that was registered to the original that it is a copy of.
struct Copy {
    const Surface& original; ///< as body_of() mends it
    const Surface& surface;
    const Registrar& registrar; ///< of the original
    Registration registration;
};

/// Where its vertices stand on the original, laid on it: no feet where that is missing.
[[nodiscard]] std::vector<Foot> feet_on_original(const Copy& copy, const Surface& laid);

/// Per vertex of the original whether that place is there in the copy laid on it, and was not cut off.
[[nodiscard]] std::vector<char> places_that_are_left(const Copy& copy, const Surface& laid);

/// Turns all faces to look the other way.
void turn_round(Surface& surface);

/// A copy laid on its original: in the original's place, at its size, its faces looking the same way.
[[nodiscard]] Surface laid_on_original(const Surface& surface, const Registration& registration);
[[nodiscard]] inline Surface laid_on_original(const Copy& copy)
{
    return laid_on_original(copy.surface, copy.registration);
}

/// The same by a given pose.
[[nodiscard]] Surface laid_by(const Eigen::Affine3d& pose, const Surface& surface, const Registration& registration);

} // namespace vcg_ext
