// SPDX-License-Identifier: GPL-3.0-or-later
#include "raw_moments.h"

#include "../base/parallel.h"
#include "../base/vectorized.h"

#include <algorithm>
#include <cmath>

namespace vcg_ext {

namespace {

using Corner = std::array<Lanes, 3>; ///< of as many triangles as there are lanes

/// 1, x, y, z, xx, xy, xz, yy, yz, zz, xxx, xxy, ..., zzz; a lane sums each fourth triangle.
struct Sums {
    std::array<StoredLanes, 20> of{};
};

/// What the integrals of degree 1 to 3 are divided by.
struct Divisors {
    double first, second, third;
};

inline void volumes(const Corner& a, const Corner& b, const Corner& c, Lanes& measure)
{
    measure =
        (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) /
        6;
}

inline void areas(const Corner& a, const Corner& b, const Corner& c, Lanes& measure)
{
    Lanes squared{};
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        const Lanes normal = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
        squared += normal * normal;
    }
    for (int lane = 0; lane < lanes; ++lane)
        measure[lane] = std::sqrt(squared[lane]) / 2;
}

/// Takes up simplices. Those of the third degree are the polarised h_3 = (s^3 + 3 s p2 + 2 p3) / 6.
inline void take(Sums& sums, const Lanes& measure, const Divisors& by, const Corner& a, const Corner& b,
                 const Corner& c)
{
    Lanes sum[3];
    Lanes pairs[3][3];
    int next = 0;
    sums.of[next++].value += measure;
    for (int i = 0; i < 3; ++i) {
        sum[i] = a[i] + b[i] + c[i];
        sums.of[next++].value += measure / by.first * sum[i];
    }
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j) {
            pairs[i][j] = a[i] * a[j] + b[i] * b[j] + c[i] * c[j];
            pairs[j][i] = pairs[i][j];
            sums.of[next++].value += measure / by.second * (pairs[i][j] + sum[i] * sum[j]);
        }
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j)
            for (int k = j; k < 3; ++k)
                sums.of[next++].value +=
                    measure / by.third *
                    (sum[i] * sum[j] * sum[k] + sum[i] * pairs[j][k] + sum[j] * pairs[i][k] + sum[k] * pairs[i][j] +
                     2 * (a[i] * a[j] * a[k] + b[i] * b[j] * b[k] + c[i] * c[j] * c[k]));
}

VCG_EXT_VECTORIZED void take_range(Of of, Sums& sums, const Points& points, const Triangle* triangles, int count,
                                   const Point& origin)
{
    const Divisors by = of == Of::Solid ? Divisors{4, 20, 120} : Divisors{3, 12, 60};
    for (int first = 0; first < count; first += lanes) {
        std::array<Corner, 3> corners{}; // lanes beyond the last stay at the origin, and add nothing
        const int filled = std::min(lanes, count - first);
        for (int lane = 0; lane < filled; ++lane)
            for (int corner = 0; corner < 3; ++corner) {
                const Point& p = points[triangles[first + lane][corner]];
                for (int axis = 0; axis < 3; ++axis)
                    corners[corner][axis][lane] = p[axis] - origin[axis];
            }
        const auto& [a, b, c] = corners;
        Lanes measure;
        of == Of::Solid ? volumes(a, b, c, measure) : areas(a, b, c, measure);
        take(sums, measure, by, a, b, c);
    }
}

} // namespace

RawMoments raw_moments(Of of, const Points& points, const std::vector<Triangle>& triangles, const Point& origin)
{
    constexpr int chunk = 4096;
    const int count = static_cast<int>(triangles.size());
    std::vector<Sums> parts(chunk_count(count, chunk), Sums{});
    for_chunks(count, chunk, [&](int begin, int end) {
        take_range(of, parts[begin / chunk], points, triangles.data() + begin, end - begin, origin);
    });
    Sums sums{};
    for (const Sums& part : parts)
        for (std::size_t i = 0; i < sums.of.size(); ++i)
            sums.of[i].value += part.of[i].value;

    int next = 0;
    const auto total = [&] {
        const Lanes& s = sums.of[next++].value;
        return s[0] + s[1] + s[2] + s[3];
    };
    RawMoments result;
    result.measure = total();
    for (int i = 0; i < 3; ++i)
        result.first[i] = total();
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j)
            result.second(i, j) = result.second(j, i) = total();
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j)
            for (int k = j; k < 3; ++k) {
                const double m = total();
                result.third[i](j, k) = result.third[i](k, j) = m;
                result.third[j](i, k) = result.third[j](k, i) = m;
                result.third[k](i, j) = result.third[k](j, i) = m;
            }
    return result;
}

} // namespace vcg_ext
