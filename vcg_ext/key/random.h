// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"
#include "stream.h"

#include <cmath>
#include <cstdint>
#include <string_view>

namespace vcg_ext {

/// Draws that are open to all, from a number instead of a key: for attacks and for sampling.
///
/// \param purpose up to 16 characters; two purposes under one seed are independent
/// \param part    a piece of the work, so that pieces draw by themselves, whichever thread does them
[[nodiscard]] Stream seeded_stream(std::uint64_t seed, std::string_view purpose, std::uint64_t part = 0);

/// Uniform in [0, 1), in steps of 2^-53: an integer and one exact product, the same on all platforms.
[[nodiscard]] double uniform(Stream& stream);

/// A direction in space, uniformly distributed: an integer point of the cube [-2^20, 2^20]^3, drawn again outside its
/// inscribed ball. Not of unit length. Draws and tests are on integers, so it is the same on all platforms to the bit.
///
/// Part of a mark's format: the source of geodesic strips lies where it points. Where nothing is to be found again,
/// direction<3>() has the unit length.
[[nodiscard]] Point integer_direction(Stream& stream);

/// A uniformly distributed unit vector of 3 or 4 dimensions, by rejection from the cube: no function but the square
/// root, which IEEE 754 rounds correctly.
template <int Dimensions>
[[nodiscard]] Eigen::Matrix<double, Dimensions, 1> direction(Stream& stream)
{
    for (;;) {
        Eigen::Matrix<double, Dimensions, 1> v;
        for (double& x : v)
            x = 2 * uniform(stream) - 1;
        const double squared = v.squaredNorm();
        if (squared <= 1 && squared > 1e-4)
            return v / std::sqrt(squared);
    }
}

} // namespace vcg_ext
