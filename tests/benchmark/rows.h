// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "vcg_ext/attack/attack.h"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

/// A row of a table: what befalls a marked mesh.
struct Row {
    std::string label;
    std::vector<vcg_ext::AttackOptions> attacks; ///< one after the other
};

inline void spoil(vcg_ext::Surface& surface, const Row& row, std::uint64_t seed)
{
    for (vcg_ext::AttackOptions attack : row.attacks) {
        attack.seed = seed;
        (void)apply_attack(surface, attack);
    }
}

/// What every blind table is made of.
inline const std::vector<Row>& blind_rows()
{
    using vcg_ext::Attack;
    static const std::vector<Row> all = {
        {"none", {{Attack::Reorder}}},
        {"similarity", {{Attack::Similarity}}},
        {"mirrored", {{Attack::Mirror}}},
        {"noise .1 %", {{Attack::Noise, 0.001}}},
        {"noise .3 %", {{Attack::Noise, 0.003}}},
        {"noise .5 %", {{Attack::Noise, 0.005}}},
        {"quantization 9", {{Attack::Quantize, 9}}},
        {"quantization 8", {{Attack::Quantize, 8}}},
        {"quantization 7", {{Attack::Quantize, 7}}},
        {"simplification 50 %", {{Attack::Simplify, 0.5}}},
        {"simplification 75 %", {{Attack::Simplify, 0.75}}},
        {"simplification 90 %", {{Attack::Simplify, 0.9}}},
        {"subdivision", {{Attack::Subdivide}}},
        {"remeshing x1", {{Attack::Remesh, 1, 3}}},
        {"remeshing x2", {{Attack::Remesh, 2, 3}}},
        {"resampling 50 %", {{Attack::Resample, 0.5}}},
        {"isosurface .5 %", {{Attack::Isosurface, 0.005}}},
        {"isosurface 1 %", {{Attack::Isosurface, 0.01}}},
        {"smoothing .5 x 5", {{Attack::Smooth, 0.5, 5}}},
        {"smoothing .5 x 10", {{Attack::Smooth, 0.5, 10}}},
    };
    return all;
}

/// Those of blind_rows() with these labels.
inline std::vector<Row> blind_rows(const std::vector<std::string>& labels)
{
    std::vector<Row> chosen;
    for (const std::string& label : labels) {
        const std::size_t before = chosen.size();
        for (const Row& row : blind_rows())
            if (row.label == label)
                chosen.push_back(row);
        if (chosen.size() == before)
            throw std::invalid_argument("no row " + label);
    }
    return chosen;
}
