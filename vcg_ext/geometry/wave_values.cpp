// SPDX-License-Identifier: GPL-3.0-or-later
#include "wave_values.h"

#include "../base/parallel.h"
#include "../base/vectorized.h"
#include "turns.h"
#include "wave_columns.h"

namespace vcg_ext {

namespace {

/// cos(q . p + phase), for all waves.
VCG_EXT_VECTORIZED void cosines(const WaveColumns& q, const double* __restrict phase, const Point& p,
                                double* __restrict out)
{
    const double* __restrict qx = q.x.data();
    const double* __restrict qy = q.y.data();
    const double* __restrict qz = q.z.data();
    const double x = p[0], y = p[1], z = p[2];
    for (std::size_t k = 0; k < q.count; ++k) {
        double s, c;
        sine_cosine(qx[k] * x + qy[k] * y + qz[k] * z + phase[k], s, c);
        out[k] = c;
    }
}

} // namespace

std::vector<double> wave_values(const Points& points, const Points& waves, const std::vector<double>& phases)
{
    const WaveColumns q(waves);
    std::vector<double> values(points.size() * q.count);
    for_chunks(static_cast<int>(points.size()), 1024, [&](int begin, int end) {
        for (int v = begin; v < end; ++v)
            cosines(q, phases.data(), points[v], values.data() + v * q.count);
    });
    return values;
}

std::vector<double> sums_of_waves(const Points& points, const Points& waves, const std::vector<double>& phases,
                                  const std::vector<double>& amplitudes)
{
    const WaveColumns q(waves);
    std::vector<double> field(points.size());
    for_chunks(static_cast<int>(points.size()), 1024, [&](int begin, int end) {
        std::vector<double> values(q.count);
        for (int v = begin; v < end; ++v) {
            cosines(q, phases.data(), points[v], values.data());
            double sum = 0;
            for (std::size_t k = 0; k < q.count; ++k)
                sum += amplitudes[k] * values[k];
            field[v] = sum;
        }
    });
    return field;
}

} // namespace vcg_ext
