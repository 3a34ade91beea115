// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/load.h"
#include "support/shapes.h"
#include "vcg_ext/base/parallel.h"
#include "vcg_ext/base/pi.h"
#include "vcg_ext/geometry/solid_transform.h"
#include "vcg_ext/geometry/turns.h"
#include "vcg_ext/geometry/wave_values.h"

#include <cmath>
#include <gtest/gtest.h>

namespace {

using namespace vcg_ext;
using Complex = std::complex<double>;

/// Integral of exp(i q x) over [0, a].
Complex interval(double q, double a)
{
    return std::abs(q) < 1e-12 ? Complex(a) : (std::exp(Complex(0, q * a)) - 1.0) / Complex(0, q);
}

TEST(Turns, SineAndCosineAreThoseOfTheLibrary)
{
    for (int i = -100000; i <= 100000; ++i) {
        const double x = i * 0.00137;
        double s, c;
        sine_cosine(x, s, c);
        ASSERT_NEAR(s, std::sin(x), 2e-13 + 4e-16 * std::abs(x)) << x;
        ASSERT_NEAR(c, std::cos(x), 2e-13 + 4e-16 * std::abs(x)) << x;
    }
}

TEST(SolidTransform, BoxHasItsTextbookTransform)
{
    // Few triangles of many radians an edge; and waves square to faces and edges, where phases coincide.
    const Surface box = shapes::box(3, 2, 1);
    const Points waves{{5, 7, 11},  {0, 0, 12},        {0, 15, 0},   {10, 0, 0},     {3, 4, 0},
                       {0.1, 0, 0}, {0.3, -0.2, 0.05}, {2, -3, 0.5}, {2, 3, 1e-9},   {-20, 1, 1e-5},
                       {1, 1, 1},   {2, 3, 6},         {0, 1e-3, 1}, {-0.7, 1.2, 2}, {6, 6.001, -18}};
    const std::vector<Complex> found = solid_transform(box.points, box.triangles, waves);
    for (std::size_t k = 0; k < waves.size(); ++k) {
        const Point& q = waves[k];
        const Complex exact = interval(q[0], 3) * interval(q[1], 2) * interval(q[2], 1) / (4 * pi);
        EXPECT_LT(std::abs(found[k] - exact), 1e-12) << q.transpose();
    }
}

TEST(SolidTransform, TrianglesOfAllSizesMakeTheSameSolid)
{
    // A tetrahedron as four triangles, and with one side cut into ever smaller ones: each form of the integral is
    // used: divided differences, series by triangle, and at last cells (4,096 triangles and more).
    Surface whole{{{0, 0, 0}, {3, 0.2, 0.1}, {0.3, 1.7, 0}, {0.5, 0.1, 0.8}},
                  {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    const Points waves{{5, 7, 11}, {0, 0, 12}, {-8, 15, 3}, {14, 0.1, 0}, {3, 4, 9}};
    const std::vector<Complex> exact = solid_transform(whole.points, whole.triangles, waves);
    Surface cut = whole;
    for (int round = 0; round < 7; ++round) {
        std::vector<Triangle> finer;
        for (const Triangle& t : cut.triangles) {
            const int n = static_cast<int>(cut.points.size());
            for (int k = 0; k < 3; ++k)
                cut.points.emplace_back((cut.points[t[k]] + cut.points[t[(k + 1) % 3]]) / 2);
            finer.insert(finer.end(), {{t[0], n, n + 2}, {n, t[1], n + 1}, {n + 2, n + 1, t[2]}, {n, n + 1, n + 2}});
        }
        cut.triangles = finer;
        const std::vector<Complex> found = solid_transform(cut.points, cut.triangles, waves);
        for (std::size_t k = 0; k < waves.size(); ++k)
            EXPECT_LT(std::abs(found[k] - exact[k]), round < 5 ? 1e-8 : 1e-7) << round << ": " << waves[k].transpose();
    }
}

TEST(SolidTransform, ShiftMultipliesByAPhaseAndTurnTurnsTheWaves)
{
    const Surface body = load("blob.off");
    const Point axis = Point(1, 2, 2) / 3;
    const Point shift(0.4, -1.3, 2.2);
    const Surface other = shapes::moved(body, 1, 0.8, axis, shift);
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.8, axis).toRotationMatrix();
    const Points waves{{5, 7, 11}, {0, 0, 12}, {-8, 15, 3}};
    Points turned;
    for (const Point& q : waves)
        turned.emplace_back(rotation * q);
    const std::vector<Complex> before = solid_transform(body.points, body.triangles, waves);
    const std::vector<Complex> after = solid_transform(other.points, other.triangles, turned);
    for (std::size_t k = 0; k < waves.size(); ++k)
        EXPECT_LT(std::abs(after[k] - before[k] * std::exp(Complex(0, turned[k].dot(shift)))), 1e-9);
}

TEST(SolidTransform, ThreadsHaveNoPartInTheResult)
{
    const Surface body = load("blobby.off");
    const Points waves{{5, 7, 11}, {0, 0, 12}, {-8, 15, 3}};
    set_threads(1);
    const std::vector<Complex> one = solid_transform(body.points, body.triangles, waves);
    set_threads(7);
    const std::vector<Complex> seven = solid_transform(body.points, body.triangles, waves);
    set_threads(0);
    EXPECT_EQ(one, seven);
}

TEST(WaveValues, SumIsThatOfTheWaves)
{
    const Points points{{0.1, 0.2, 0.3}, {-1, 2, 0.5}};
    const Points waves{{5, 7, 11}, {0, 0, 12}, {-8, 15, 3}};
    const std::vector<double> phases{0.3, 2, 5};
    const std::vector<double> amplitudes{1, -2, 0.5};
    const std::vector<double> field = sums_of_waves(points, waves, phases, amplitudes);
    const std::vector<double> values = wave_values(points, waves, phases);
    for (std::size_t v = 0; v < points.size(); ++v) {
        double sum = 0;
        for (std::size_t k = 0; k < waves.size(); ++k) {
            EXPECT_NEAR(values[v * 3 + k], std::cos(waves[k].dot(points[v]) + phases[k]), 1e-13);
            sum += amplitudes[k] * std::cos(waves[k].dot(points[v]) + phases[k]);
        }
        EXPECT_NEAR(field[v], sum, 1e-12);
    }
}

} // namespace
