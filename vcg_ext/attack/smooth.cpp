#include "smooth.h"

#include "../parallel.h"

#include <algorithm>

namespace vcg_ext {

namespace {

/// The vertices that share an edge with `v`, each once, in ascending order.
void neighbours(int v, const VertexFaces& around, const std::vector<Triangle>& triangles, std::vector<int>& result)
{
    result.clear();
    for (const int* f = around.begin(v); f != around.end(v); ++f)
        for (const int other : triangles[*f])
            if (other != v)
                result.push_back(other);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
}

} // namespace

Points smooth(const Surface& surface, double lambda, int iterations, const Progress& progress)
{
    const Welded welded = weld(surface);
    const std::vector<Triangle>& triangles = welded.surface.triangles;
    const int vertices = static_cast<int>(welded.surface.points.size());
    const VertexFaces around = vertex_faces(vertices, triangles);
    Points now = welded.surface.points;
    Points next = now;
    for (int i = 0; i < iterations; ++i) {
        report(progress, 100 * i / iterations, "Smoothing");
        for_chunks(vertices, 4096, [&](int begin, int end) {
            std::vector<int> ring;
            for (int v = begin; v < end; ++v) {
                neighbours(v, around, triangles, ring);
                Point sum = Point::Zero();
                for (const int other : ring)
                    sum += now[other];
                next[v] = now[v] + lambda * (sum / static_cast<double>(ring.size()) - now[v]);
            }
        });
        now.swap(next);
    }
    return unweld(surface.points, welded.site_of_vertex, now);
}

} // namespace vcg_ext
