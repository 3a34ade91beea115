// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangle_transform.h"

#include "../base/vectorized.h"
#include "turns.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace vcg_ext {

namespace {

/// Adds (q . n) times the mean of exp(i q . x) over a triangle, for all waves, by the series of `Terms` homogeneous
/// polynomials about the centroid: 2 h_n / (n + 2)!, where h_n = -e2 h_(n-2) + e3 h_(n-3), since h_1 is 0.
template <int Terms>
void add_series(const WaveColumns& q, const Point& centre, const Point& to_a, const Point& to_b, const Point& n,
                WaveSums& sums)
{
    const double* __restrict qx = q.x.data();
    const double* __restrict qy = q.y.data();
    const double* __restrict qz = q.z.data();
    double* __restrict re = sums.re.data();
    double* __restrict im = sums.im.data();
    const double cx = centre[0], cy = centre[1], cz = centre[2];
    const double ax = to_a[0], ay = to_a[1], az = to_a[2];
    const double bx = to_b[0], by = to_b[1], bz = to_b[2];
    const double nx = n[0], ny = n[1], nz = n[2];
    for (std::size_t k = 0; k < q.count; ++k) {
        double s, c;
        sine_cosine(qx[k] * cx + qy[k] * cy + qz[k] * cz, s, c);
        const double a = qx[k] * ax + qy[k] * ay + qz[k] * az;
        const double b = qx[k] * bx + qy[k] * by + qz[k] * bz;
        const double g = qx[k] * nx + qy[k] * ny + qz[k] * nz;
        const double sum = a + b;
        const double e2 = a * b - sum * sum;
        const double e3 = -a * b * sum;
        double h0 = 1, h1 = 0, h2 = -e2;
        double real = 1 + e2 * (1.0 / 12), imaginary = 0;
        double factor = 1.0 / 12; // 2 / (n + 2)!
        for (int m = 3; m < Terms; ++m) {
            const double h = e3 * h0 - e2 * h1;
            factor /= m + 2;
            if (m % 4 == 0)
                real += factor * h;
            else if (m % 4 == 1)
                imaginary += factor * h;
            else if (m % 4 == 2)
                real -= factor * h;
            else
                imaginary -= factor * h;
            h0 = h1;
            h1 = h2;
            h2 = h;
        }
        re[k] += g * (real * c - imaginary * s);
        im[k] += g * (real * s + imaginary * c);
    }
}

double sinc(double x)
{
    return std::abs(x) < 1e-4 ? 1 - x * x / 6 : sine(x) / x;
}

/// First divided difference of exp(i t).
std::complex<double> divided(double a, double b)
{
    double s, c;
    sine_cosine((a + b) / 2, s, c);
    return sinc((a - b) / 2) * std::complex<double>(c, s);
}

/// The same for a triangle of any size: by divided differences over the pair of corners that lies farthest apart.
void add_exact(const WaveColumns& q, const Point& centre, const Point& to_a, const Point& to_b, const Point& n,
               WaveSums& sums)
{
    for (std::size_t k = 0; k < q.count; ++k) {
        const Point wave(q.x[k], q.y[k], q.z[k]);
        double t[3] = {wave.dot(to_a), wave.dot(to_b), 0};
        t[2] = -t[0] - t[1];
        if (std::max({std::abs(t[0]), std::abs(t[1]), std::abs(t[2])}) <= 2)
            continue; // add_series' part
        std::sort(t, t + 3);
        const std::complex<double> difference = (divided(t[2], t[1]) - divided(t[1], t[0])) / (t[2] - t[0]);
        double s, c;
        sine_cosine(wave.dot(centre), s, c);
        // exp[a, b, c] with respect to i t: one more 1 / i
        const std::complex<double> mean =
            2.0 * std::complex<double>(difference.imag(), -difference.real()) * std::complex<double>(c, s);
        sums.re[k] += wave.dot(n) * mean.real();
        sums.im[k] += wave.dot(n) * mean.imag();
    }
}

/// The series for those waves only whose phases lie close together.
void add_mixed(const WaveColumns& q, const Point& centre, const Point& to_a, const Point& to_b, const Point& n,
               WaveSums& sums)
{
    Points close;
    std::vector<std::size_t> which;
    for (std::size_t k = 0; k < q.count; ++k) {
        const Point wave(q.x[k], q.y[k], q.z[k]);
        const double a = wave.dot(to_a);
        const double b = wave.dot(to_b);
        if (std::max({std::abs(a), std::abs(b), std::abs(a + b)}) <= 2) {
            close.push_back(wave);
            which.push_back(k);
        }
    }
    WaveSums part(close.size());
    add_series<22>(WaveColumns(close), centre, to_a, to_b, n, part);
    for (std::size_t i = 0; i < which.size(); ++i) {
        sums.re[which[i]] += part.re[i];
        sums.im[which[i]] += part.im[i];
    }
    add_exact(q, centre, to_a, to_b, n, sums);
}

} // namespace

VCG_EXT_VECTORIZED void add_triangle(const WaveColumns& q, const Points& points, const Triangle& t, double spread,
                                     WaveSums& sums)
{
    const Point centre = (points[t[0]] + points[t[1]] + points[t[2]]) / 3;
    const Point a = points[t[0]] - centre;
    const Point b = points[t[1]] - centre;
    const Point n = scaled_normal(points, t) / 2;
    if (spread < 0.1)
        add_series<5>(q, centre, a, b, n, sums);
    else if (spread < 0.5)
        add_series<9>(q, centre, a, b, n, sums);
    else if (spread < 2)
        add_series<16>(q, centre, a, b, n, sums);
    else
        add_mixed(q, centre, a, b, n, sums);
}

} // namespace vcg_ext
