// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid_transform.h"

#include "../base/parallel.h"
#include "../base/pi.h"
#include "triangle_cells.h"
#include "triangle_transform.h"

#include <algorithm>
#include <cmath>

namespace vcg_ext {

std::vector<std::complex<double>> solid_transform(const Points& points, const std::vector<Triangle>& triangles,
                                                  const Points& waves, double longest)
{
    constexpr int chunk = 1024;
    constexpr int cells_chunk = 64;
    const int count = static_cast<int>(triangles.size());
    const WaveColumns q(waves);
    double largest = longest;
    for (const Point& wave : waves)
        largest = std::max(largest, wave.norm());
    const TriangleCells cells(q, points, triangles, largest);

    const int triangle_parts = chunk_count(count, chunk);
    std::vector<WaveSums> partial(triangle_parts + chunk_count(cells.count(), cells_chunk), WaveSums(q.count));
    for_chunks(count, chunk, [&](int begin, int end) {
        WaveSums& sums = partial[begin / chunk];
        for (int f = begin; f < end; ++f)
            if (!cells.holds(f))
                add_triangle(q, points, triangles[f], std::sqrt(squared_spread(points, triangles[f], largest)), sums);
    });
    for_chunks(cells.count(), cells_chunk, [&](int begin, int end) {
        WaveSums& sums = partial[triangle_parts + begin / cells_chunk];
        for (int i = begin; i < end; ++i)
            cells.add(i, sums);
    });

    std::vector<std::complex<double>> result(q.count);
    for (std::size_t k = 0; k < q.count; ++k) {
        double re = 0, im = 0;
        for (const WaveSums& part : partial) {
            re += part.re[k];
            im += part.im[k];
        }
        result[k] = std::complex<double>(im, -re) / (4 * pi * waves[k].squaredNorm());
    }
    return result;
}

} // namespace vcg_ext
