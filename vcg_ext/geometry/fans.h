// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// The vertices around each vertex as its faces stand there: two that follow each other are a face with it.
///
/// A closed fan ends with the vertex that it begins with. Where faces are no single fan, `gap` stands between them.
struct Fans {
    static constexpr int gap = -1;

    std::vector<int> first;     ///< one more than there are vertices
    std::vector<int> neighbour; ///< of vertex `v` those from first[v] to first[v + 1]

    [[nodiscard]] int vertices() const { return static_cast<int>(first.size()) - 1; }
    [[nodiscard]] const int* begin(int v) const { return neighbour.data() + first[v]; }
    [[nodiscard]] const int* end(int v) const { return neighbour.data() + first[v + 1]; }
};

/// \param around of the triangles
[[nodiscard]] Fans fans_of(const VertexFaces& around, const std::vector<Triangle>& triangles);

} // namespace vcg_ext
