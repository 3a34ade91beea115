// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/base/vcg_point.h"
#include "vcg_ext/geometry/nearest.h"

#include <gtest/gtest.h>
#include <random>
#include <vcg/space/distance3.h>
#include <vcg/space/triangle3.h>

using namespace vcg_ext;

namespace {

double by_vcglib(const Point& a, const Point& b, const Point& c)
{
    double distance = 0;
    vcg::Point3d nearest;
    vcg::TrianglePointDistance(vcg::Triangle3<double>(to_vcg(a), to_vcg(b), to_vcg(c)), vcg::Point3d(0, 0, 0), distance,
                               nearest);
    return nearest.Norm();
}

TEST(Nearest, IsAsFarAsVcglibFinds)
{
    std::mt19937 draws(7);
    const auto number = [&draws] { return static_cast<double>(draws()) / 4294967296.0 - 0.5; };
    const auto point = [&number](double size) { return Point(size * number(), size * number(), size * number()); };
    for (int i = 0; i < 20000; ++i) {
        const Point middle = point(i % 4);
        const Point a = middle + point(1);
        const Point b = middle + point(1);
        const Point c = middle + point(1);
        const double expected = by_vcglib(a, b, c);
        ASSERT_NEAR(nearest_to_origin(a, b, c).norm(), expected, 1e-12) << i;
    }
}

TEST(Nearest, IsOnTrianglesWithoutAreaToo)
{
    const Point a(1, 2, 2);
    EXPECT_EQ(nearest_to_origin(a, a, a), a);
    EXPECT_LT((nearest_to_origin({1, -1, 0}, {1, 1, 0}, {1, 3, 0}) - Point(1, 0, 0)).norm(), 1e-15);
    EXPECT_LT((nearest_to_origin({1, 3, 0}, {1, -1, 0}, {1, 1, 0}) - Point(1, 0, 0)).norm(), 1e-15);
    EXPECT_LT((nearest_to_origin({1, 1, 0}, {1, 3, 0}, {1, -1, 0}) - Point(1, 0, 0)).norm(), 1e-15);
    EXPECT_LT((nearest_to_origin({1, -1, 0}, {1, -1, 0}, {1, 3, 0}) - Point(1, 0, 0)).norm(), 1e-15);
    EXPECT_LT((nearest_to_origin({1, -1, 0}, {1, 3, 0}, {1, -1, 0}) - Point(1, 0, 0)).norm(), 1e-15);
    EXPECT_LT((nearest_to_origin({1, 3, 0}, {1, -1, 0}, {1, -1, 0}) - Point(1, 0, 0)).norm(), 1e-15);
}

} // namespace
