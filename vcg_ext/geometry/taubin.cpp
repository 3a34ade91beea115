#include "taubin.h"

#include "../base/parallel.h"

namespace vcg_ext {

Points taubin(const EdgeGraph& graph, Points points, int passes, double shrink, double inflate)
{
    Points moved(points.size());
    for (int pass = 0; pass < passes; ++pass)
        for (const double part : {shrink, inflate}) {
            for_each_index(graph.vertices(), [&](int v) {
                const int degree = graph.degree(v);
                moved[v] = degree > 0 ? Point(points[v] - part / degree * laplacian_row(graph, points, v)) : points[v];
            });
            points.swap(moved);
        }
    return points;
}

} // namespace vcg_ext
