// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace vcg_ext {

/// How a mesh carries its bits; in the order in which users choose.
enum class Method {
    Layered,  ///< Waves, and one of the others on top: each survives what the other does not
    Waves,    ///< Fourier coefficients of the solid, moved by a smooth field
    LM,       ///< vertex norms, sphere placement by Levenberg-Marquardt (thesis 5.5)
    QSP,      ///< vertex norms, quadric selective placement (thesis 5.4)
    Cho,      ///< vertex norms, radial placement (Cho et al.)
    Geodesic, ///< geodesic distances, front placement (thesis chapter 4)
    Spectral  ///< spectral coefficients of patches (thesis chapter 3)
};

[[nodiscard]] const char* name(Method method);

} // namespace vcg_ext
