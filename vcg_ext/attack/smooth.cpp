#include "smooth.h"

#include "../base/parallel.h"
#include "../base/progress.h"
#include "../base/weld.h"
#include "../geometry/neighbours.h"

namespace vcg_ext {

Points smooth(const Surface& surface, double lambda, int iterations, const Progress& progress)
{
    const Welded welded = weld(surface);
    const int vertices = static_cast<int>(welded.surface.points.size());
    const Neighbours ring = neighbours(vertices, welded.surface.triangles);
    Points now = welded.surface.points;
    Points next = now;
    for (int i = 0; i < iterations; ++i) {
        report(progress, 100 * i / iterations, "Smoothing");
        for_each_index(vertices, [&](int v) {
            Point sum = Point::Zero();
            for (const int* other = ring.begin(v); other != ring.end(v); ++other)
                sum += now[*other];
            next[v] = now[v] + lambda * (sum / ring.count(v) - now[v]);
        });
        now.swap(next);
    }
    return unweld(surface.points, welded.site_of_vertex, now);
}

} // namespace vcg_ext
