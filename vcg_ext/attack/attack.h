// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/error.h"
#include "../base/progress.h"
#include "../base/surface.h"

#include <cstdint>
#include <string>
#include <vector>

namespace vcg_ext {

/// What a stego mesh may have to survive (thesis 1.1.6, 3.6.4), in the order in which users choose.
enum class Attack {
    Noise,      ///< (3.24): each vertex in a random direction
    Smooth,     ///< Laplacian, uniform weights
    Simplify,   ///< quadric edge collapse
    Quantize,   ///< coordinates to a number of bits
    Resample,   ///< new vertices, evenly spread, to a part of their number
    Remesh,     ///< isotropic, to an edge length
    Isosurface, ///< marching cubes of the signed distance
    Subdivide,  ///< at the midpoints of the edges
    Crop,       ///< by a random plane
    Similarity, ///< random rotation, translation, uniform scale
    Affine,     ///< random stretch and shear
    Reorder,    ///< vertices and faces in random order
    Taubin,     ///< smoothing without shrinking
    Loop,       ///< subdivision that smooths
    Sqrt3,      ///< subdivision that smooths, of other faces
    Mirror,     ///< the mirror image
    Plate       ///< copies side by side
};

/// All attacks, in the order of the enumeration.
[[nodiscard]] const std::vector<Attack>& all_attacks();

[[nodiscard]] const char* name(Attack attack);

/// What an attack's `amount` and `iterations` mean and may be.
struct AttackRange {
    const char* amount_is = nullptr; ///< what the amount is; null where the attack has none, and ignores it
    double amount = 0;               ///< taken where the caller gives -1
    double least = 0;
    double most = 0;
    int iterations = 0;          ///< taken where the caller gives -1; 0 where the attack has none, and ignores it
    int most_iterations = 0;     ///< the least is 1
    bool whole = false;          ///< the amount must be a whole number
    bool positions_only = false; ///< vertices and faces keep their number and order
    bool seeded = false;         ///< the seed matters
};

[[nodiscard]] const AttackRange& range(Attack attack);

struct AttackOptions {
    Attack attack = Attack::Noise;
    double amount = -1;     ///< in the attack's own unit, see range(); -1 is its usual value
    int iterations = -1;    ///< -1 is the attack's usual number
    std::uint64_t seed = 0; ///< of all random draws
};

struct AttackReport {
    Attack attack{};             ///< its name
    double amount = 0;           ///< as used; 0 where the attack has none
    int iterations = 0;          ///< as used; 0 where the attack has none
    std::uint64_t seed = 0;      ///< as given
    int vertices = 0;            ///< afterwards
    int faces = 0;               ///< afterwards
    bool positions_only = false; ///< vertices and faces kept their number and order: writing positions back is enough
};

/// Does to `surface` what a user or an adversary might. Same input, same result: on any machine, at any
/// number of threads.
///
/// Vertices at one position move together (see weld()), so a mesh without shared vertices stays closed. Attacks that
/// rebuild the mesh weld it first, and give back a welded one.
///
/// \throw Error      where an option is out of its range, which the text names, or the mesh cannot take the attack.
///                   `surface` is unchanged.
/// \throw Cancelled  where `progress` returned false. `surface` is unchanged.
AttackReport apply_attack(Surface& surface, const AttackOptions& options, const Progress& progress = {});

} // namespace vcg_ext
