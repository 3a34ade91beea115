// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/shapes.h"
#include "vcg_ext/geometry/raw_moments.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

const Point size(3, 1, 3.5);

/// The box from 0 to `size`, its first triangle cut into three: 14 are no whole number of lanes.
Surface cut_box()
{
    Surface cut = shapes::box(size[0], size[1], size[2]);
    const auto [a, b, c] = cut.triangles.front();
    const int middle = static_cast<int>(cut.points.size());
    cut.points.push_back((cut.points[a] + cut.points[b] + cut.points[c]) / 3);
    cut.triangles.front() = {a, b, middle};
    cut.triangles.insert(cut.triangles.end(), {{b, c, middle}, {c, a, middle}});
    return cut;
}

/// Integral of x^i y^j z^k over the box, about `origin`.
double exact(const Point& origin, std::array<int, 3> powers)
{
    double product = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const int n = powers[axis] + 1;
        product *= (std::pow(size[axis] - origin[axis], n) - std::pow(-origin[axis], n)) / n;
    }
    return product;
}

TEST(RawMoments, OfABoxAreProductsOfPowers)
{
    const Surface surface = cut_box();
    const Point origin(0.3, -0.7, 1.1);
    const RawMoments m = raw_moments(Of::Solid, surface.points, surface.triangles, origin);
    const auto near = [&](double value, std::array<int, 3> powers) {
        EXPECT_NEAR(value, exact(origin, powers), 1e-12 * std::abs(exact(origin, {2, 2, 2})));
    };
    near(m.measure, {0, 0, 0});
    for (int i = 0; i < 3; ++i) {
        std::array<int, 3> one{};
        ++one[i];
        near(m.first[i], one);
        for (int j = 0; j < 3; ++j) {
            std::array<int, 3> two = one;
            ++two[j];
            near(m.second(i, j), two);
            for (int k = 0; k < 3; ++k) {
                std::array<int, 3> three = two;
                ++three[k];
                near(m.third[i](j, k), three);
            }
        }
    }
}

} // namespace
