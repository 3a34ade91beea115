// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// Wave vectors as columns, so that loops over them vectorise.
struct WaveColumns {
    std::vector<double> x, y, z; ///< radians per unit
    std::size_t count = 0;

    explicit WaveColumns(const Points& waves) : x(waves.size()), y(waves.size()), z(waves.size()), count(waves.size())
    {
        for (std::size_t k = 0; k < count; ++k) {
            x[k] = waves[k][0];
            y[k] = waves[k][1];
            z[k] = waves[k][2];
        }
    }
};

/// A complex number a wave, real and imaginary parts as columns.
struct WaveSums {
    std::vector<double> re, im;

    explicit WaveSums(std::size_t count) : re(count, 0), im(count, 0) {}
};

} // namespace vcg_ext
