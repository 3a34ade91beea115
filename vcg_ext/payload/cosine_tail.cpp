// SPDX-License-Identifier: GPL-3.0-or-later
#include "cosine_tail.h"

#include "../base/pi.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

namespace vcg_ext {

namespace {

/// Logarithm of the modified Bessel function of order 0, and its derivative I_1 / I_0, for x >= 0.
struct Bessel {
    double log_i0 = 0;
    double ratio = 0;
};

Bessel bessel(double x)
{
    if (x < 30) {
        double i0 = 1, i1 = x / 2, term0 = 1, term1 = x / 2;
        for (int k = 1; k < 120; ++k) {
            term0 *= x * x / 4 / (static_cast<double>(k) * k);
            term1 *= x * x / 4 / (k * (k + 1.0));
            i0 += term0;
            i1 += term1;
            if (term0 < 1e-17 * i0)
                break;
        }
        return {std::log(i0), i1 / i0};
    }
    double i0 = 1, i1 = 1, term0 = 1, term1 = 1; // asymptotic series (Abramowitz and Stegun 9.7.1)
    for (int k = 1; k < 12; ++k) {
        term0 *= (2 * k - 1.0) * (2 * k - 1.0) / (8 * k * x);
        term1 *= -(4 - (2 * k - 1.0) * (2 * k - 1.0)) / (8 * k * x);
        i0 += term0;
        i1 += term1;
    }
    return {x - std::log(2 * pi * x) / 2 + std::log(i0), i1 / i0};
}

/// Least of `value(t)` over t >= 0, convex, its derivative `slope(t)`; the bound holds at any t, so near is enough.
template <class Slope, class Value>
double least(double start, const Slope& slope, const Value& value)
{
    double low = 0;
    double high = start;
    for (int i = 0; i < 60 && slope(high) < 0; ++i) {
        low = high;
        high *= 2;
    }
    for (int i = 0; i < 40 && high - low > 1e-6 * high; ++i) {
        const double middle = (low + high) / 2;
        (slope(middle) < 0 ? low : high) = middle;
    }
    return std::min(0.0, value((low + high) / 2));
}

} // namespace

double log_tail_of_cosines(int n, double sum)
{
    if (!(sum > 0))
        return 0;
    // The sum is at most n; nearer to it than 1e-9 the bound falls no further.
    const double s = std::min(sum, n * (1 - 1e-9));
    return least(
        1, [&](double k) { return n * bessel(k).ratio - s; }, [&](double k) { return n * bessel(k).log_i0 - k * s; });
}

CosineTail::CosineTail(int n) : lines_(8 * n), scale_(8), last_(8 * n - 1)
{
    // The line of each piece is the tangent at its middle.
    double k = 0;
    for (int i = 0; i <= last_; ++i) {
        const double s = (i + 0.5) / scale_;
        double high = std::max(1e-3, 2 * k);
        while (n * bessel(high).ratio < s && high < 1e8)
            high *= 2;
        double low = k;
        for (int step = 0; step < 40; ++step) {
            const double middle = (low + high) / 2;
            (n * bessel(middle).ratio < s ? low : high) = middle;
        }
        k = low;
        lines_[i] = {k, n * bessel(k).log_i0};
    }
}

const CosineTail& cosine_tail(int n)
{
    static std::mutex guard;
    static std::map<int, CosineTail> tables;
    const std::lock_guard<std::mutex> lock(guard);
    const auto found = tables.find(n);
    return found != tables.end() ? found->second : tables.emplace(n, CosineTail(n)).first->second;
}

} // namespace vcg_ext
