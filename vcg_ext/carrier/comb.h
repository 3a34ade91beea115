// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

namespace vcg_ext {

/// How plainly a scalar's histogram is combed: pushed to and fro in equal intervals, as carriers are that hold bits of
/// whatever key. Only the number of intervals and their trim are secret, and both can be tried.
struct Comb {
    double strength = 0; ///< mean |z| of the intervals, where they fit best; some .9 where nobody combed
    double contrast =
        1; ///< the same over its median for all trims: what the shape itself does is there for most of them

    /// Whether it is a mark. One in 252 unmarked meshes and copies that were made of them looks so.
    [[nodiscard]] bool found() const { return strength > 1.6 && contrast > 1.53; }
};

/// The plainest comb that a mark may have left, of a recommended number of carriers that the mesh is fine enough for.
/// \param scalar one per vertex; those outside of [minimum, maximum] are passed over
[[nodiscard]] Comb find_comb(const std::vector<double>& scalar, double minimum, double maximum);

} // namespace vcg_ext
