// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../geometry/registration.h"

#include <optional>
#include <utility>

namespace vcg_ext {

/// A welded surface that was registered to the original that it is a copy of. What takes long is found when it is first
/// asked for, and kept: all numbers of carriers that are tried share it.
class Copy {
public:
    /// \param original as body_of() mends it, and registered by `registrar`; all three must outlive the copy
    Copy(const Surface& original, const Surface& surface, const Registrar& registrar, Registration registration)
        : original(original), surface(surface), registrar(registrar), registration(std::move(registration))
    {
    }

    /// In the original's place, at its size, its faces looking the same way.
    [[nodiscard]] const Surface& laid() const;

    /// Where its vertices stand on the original: no feet where that is missing.
    [[nodiscard]] const std::vector<Foot>& feet() const;

    /// Per vertex of the original whether that place is there in the copy, and was not cut off.
    [[nodiscard]] const std::vector<char>& left() const;

    const Surface& original;
    const Surface& surface;
    const Registrar& registrar;
    const Registration registration;

private:
    mutable std::optional<Surface> laid_;
    mutable std::optional<std::vector<Foot>> feet_;
    mutable std::optional<std::vector<char>> left_;
};

/// A copy laid on its original: in the original's place, at its size, its faces looking the same way.
[[nodiscard]] Surface laid_on_original(const Surface& surface, const Registration& registration);

/// The same by a given pose.
[[nodiscard]] Surface laid_by(const Eigen::Affine3d& pose, const Surface& surface, const Registration& registration);

} // namespace vcg_ext
