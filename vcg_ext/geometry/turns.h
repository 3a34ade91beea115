// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/pi.h"

namespace vcg_ext {

/// Sine and cosine by sums and products alone: no branch, so loops over it vectorise, and no library, so all machines
/// agree to the bit. Absolute error below 2e-13, plus the rounding of the reduction to a turn: 4e-16 |x|.
///
/// \param x radians, |x| < 1e9
inline void sine_cosine(double x, double& sine, double& cosine)
{
    constexpr double shift = 6755399441055744.0; // 1.5 * 2^52: adding it rounds to whole numbers
    const double turns = x * (0.5 / pi);
    const double whole = (turns + shift) - shift;
    const double y = (turns - whole) * (pi / 2); // a quarter of the angle, within pi / 4
    const double z = y * y;
    const double s =
        y * (1 + z * (-1.0 / 6 +
                      z * (1.0 / 120 +
                           z * (-1.0 / 5040 + z * (1.0 / 362880 + z * (-1.0 / 39916800 + z * (1.0 / 6227020800.0)))))));
    const double c =
        1 + z * (-0.5 +
                 z * (1.0 / 24 +
                      z * (-1.0 / 720 + z * (1.0 / 40320 + z * (-1.0 / 3628800 +
                                                                z * (1.0 / 479001600 + z * (-1.0 / 87178291200.0)))))));
    const double s2 = 2 * s * c; // of half the angle
    const double c2 = 1 - 2 * s * s;
    sine = 2 * s2 * c2;
    cosine = 1 - 2 * s2 * s2;
}

inline double sine(double x)
{
    double s, c;
    sine_cosine(x, s, c);
    return s;
}

inline double cosine(double x)
{
    double s, c;
    sine_cosine(x, s, c);
    return c;
}

} // namespace vcg_ext
