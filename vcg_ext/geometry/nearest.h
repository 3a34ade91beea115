// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

namespace vcg_ext {

/// The point of the triangle a, b, c that is nearest to the origin (Ericson, Real-Time Collision Detection, 5.1.5): by
/// the region of its corners, edges or inside that the origin is over. What vcglib's TrianglePointDistance finds with a
/// plane and projections to it, in a fraction of the time. A triangle without an area is as good as any.
[[nodiscard]] inline Point nearest_to_origin(const Point& a, const Point& b, const Point& c)
{
    const Point ab = b - a;
    const Point ac = c - a;
    const double ab_a = -ab.dot(a);
    const double ac_a = -ac.dot(a);
    if (ab_a <= 0 && ac_a <= 0)
        return a;
    const double ab_b = -ab.dot(b);
    const double ac_b = -ac.dot(b);
    if (ab_b >= 0 && ac_b <= ab_b)
        return b;
    const double over_c = ab_a * ac_b - ab_b * ac_a; // times the share of corner c
    if (over_c <= 0 && ab_a >= 0 && ab_b <= 0 && ab_a > ab_b)
        return a + ab_a / (ab_a - ab_b) * ab;
    const double ab_c = -ab.dot(c);
    const double ac_c = -ac.dot(c);
    if (ac_c >= 0 && ab_c <= ac_c)
        return c;
    const double over_b = ab_c * ac_a - ab_a * ac_c;
    if (over_b <= 0 && ac_a >= 0 && ac_c <= 0)
        return a + ac_a / (ac_a - ac_c) * ac;
    const double over_a = ab_b * ac_c - ab_c * ac_b;
    const double from_b = ac_b - ab_b;
    const double from_c = ab_c - ac_c;
    if (over_a <= 0 && from_b >= 0 && from_c >= 0)
        return b + from_b / (from_b + from_c) * (c - b);
    const double whole = over_a + over_b + over_c;
    return a + over_b / whole * ab + over_c / whole * ac;
}

} // namespace vcg_ext
