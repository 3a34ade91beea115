#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// The vertices that share an edge with each vertex: those of `v` are `other[first[v]] .. other[first[v + 1] - 1]`,
/// each once, in ascending order.
struct Neighbours {
    std::vector<int> first; ///< one more than there are vertices
    std::vector<int> other;

    [[nodiscard]] const int* begin(int v) const { return other.data() + first[v]; }
    [[nodiscard]] const int* end(int v) const { return other.data() + first[v + 1]; }
    [[nodiscard]] int count(int v) const { return first[v + 1] - first[v]; }
};

[[nodiscard]] Neighbours neighbours(int vertices, const std::vector<Triangle>& triangles);

} // namespace vcg_ext
