#include "neighbours.h"

#include <algorithm>

namespace vcg_ext {

Neighbours neighbours(int vertices, const std::vector<Triangle>& triangles)
{
    const VertexFaces around = vertex_faces(vertices, triangles);
    Neighbours result;
    result.first.reserve(vertices + 1);
    result.first.push_back(0);
    std::vector<int> ring;
    for (int v = 0; v < vertices; ++v) {
        ring.clear();
        for (const int* f = around.begin(v); f != around.end(v); ++f)
            for (const int other : triangles[*f])
                if (other != v)
                    ring.push_back(other);
        std::sort(ring.begin(), ring.end());
        ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
        result.other.insert(result.other.end(), ring.begin(), ring.end());
        result.first.push_back(static_cast<int>(result.other.size()));
    }
    return result;
}

} // namespace vcg_ext
