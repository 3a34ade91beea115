// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/load.h"
#include "support/march.h"
#include "support/shapes.h"
#include "vcg_ext/geometry/fast_marching.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace {

using namespace vcg_ext;

VertexFaces around(const Surface& s)
{
    return vertex_faces(static_cast<int>(s.points.size()), s.triangles);
}

struct Errors {
    double rms = 0;
    double largest = 0;
};

/// Relative errors of the march at the vertices that lie farther than `least` from the source.
template <class Exact>
Errors errors(const Surface& s, const SurfacePoint& source, double least, const Exact& exact)
{
    const std::vector<Arrival> arrivals = march(s, around(s), source);
    Errors result;
    int count = 0;
    for (std::size_t v = 0; v < arrivals.size(); ++v) {
        const double truth = exact(static_cast<int>(v));
        if (truth < least)
            continue;
        const double error = arrivals[v].distance / truth - 1;
        result.rms += error * error;
        result.largest = std::max(result.largest, std::abs(error));
        ++count;
    }
    result.rms = std::sqrt(result.rms / count);
    return result;
}

TEST(FastMarching, ExactOnAPlaneOfAcuteTriangles)
{
    const Surface s = shapes::triangular_grid(10, 10, 0.1);
    const SurfacePoint source = *farthest_hit(s, {5.02, 5.03, -1}, {0, 0, 1});
    const std::vector<Arrival> arrivals = march(s, around(s), source);
    for (std::size_t v = 0; v < arrivals.size(); ++v) {
        const Point ray = s.points[v] - source.position;
        ASSERT_NEAR(arrivals[v].distance, ray.norm(), 1e-12);
        ASSERT_LT((arrivals[v].gradient - ray.normalized()).norm(), 1e-9);
    }
}

TEST(FastMarching, ExactFromAnEdgeAndFarFromTheOrigin)
{
    const Surface s = shapes::moved(shapes::triangular_grid(3, 3, 0.1), 1, 1, {1, 2, 3}, {100, 200, -300});
    const SurfacePoint source{400, (s.points[s.triangles[400][0]] + s.points[s.triangles[400][1]]) / 2};
    const std::vector<Arrival> arrivals = march(s, around(s), source);
    for (std::size_t v = 0; v < arrivals.size(); ++v) {
        const double exact = (s.points[v] - source.position).norm();
        if (exact < 0.7) { // beyond, straight lines leave the grid at its jagged border
            EXPECT_NEAR(arrivals[v].distance, exact, 1e-11);
        }
    }
}

/// A grid rolled up to a prism of 90 sides: its geodesics are straight lines of the grid. The march starts at the
/// middle of the height, and sees the half of the prism around it.
TEST(FastMarching, CylinderUnrollsToItsPlane)
{
    const double edge = 0.1;
    const Surface flat = shapes::triangular_grid(4.45, 4, edge);
    Surface s = flat;
    // Every half edge is one side of the prism, so faces lie on two of its sides: they bend, the error is that
    // of chords.
    const double radius = 9 / (2 * std::acos(-1.0));
    for (Point& p : s.points)
        p = Point(radius * std::cos(p.x() / radius), radius * std::sin(p.x() / radius), p.y());
    const int face = static_cast<int>(s.triangles.size()) / 2 + 40;
    const auto middle = [face](const Surface& surface) {
        const auto& [a, b, c] = surface.triangles[face];
        return Point((surface.points[a] + surface.points[b] + surface.points[c]) / 3);
    };
    const Point from = middle(flat);
    const Errors e = errors(s, {face, middle(s)}, 0.4, [&](int v) { return (flat.points[v] - from).norm(); });
    // A chord of a twentieth turn in ninety is shorter than its arc by a factor sin(x)/x, x = edge / (2 radius):
    // 2.0e-4.
    EXPECT_LT(e.largest, 2.1e-4 + 1e-4);
}

TEST(FastMarching, FirstOrderOnTheSphere)
{
    double before = 0;
    for (int level = 3; level <= 6; ++level) {
        const Surface s = shapes::sphere(level);
        const SurfacePoint source = *farthest_hit(s, Point::Zero(), {0.3, 0.4, 0.5});
        const Point u = source.position.normalized();
        const double pi = std::acos(-1.0);
        const Errors e = errors(s, source, 0.1 * pi,
                                [&](int v) { return std::atan2(u.cross(s.points[v]).norm(), u.dot(s.points[v])); });
        if (level > 3) {
            EXPECT_LT(e.rms, before / 1.9) << "level " << level; // half the edge, half the error
        }
        before = e.rms;
    }
    EXPECT_LT(before, 0.001);
}

TEST(FastMarching, NeverShorterThanTheStraightLineNorLongerThanTheEdges)
{
    const Surface s = load("fandisk.off");
    const VertexFaces faces = around(s);
    const SurfacePoint source{1000, s.points[s.triangles[1000][0]]};
    const std::vector<Arrival> arrivals = march(s, faces, source);
    for (std::size_t v = 0; v < arrivals.size(); ++v) {
        // The circular wave is exact in each pair of triangles, so only rounding and the turned-back front come below.
        EXPECT_GE(arrivals[v].distance, (s.points[v] - source.position).norm() * (1 - 1e-9));
        for (const int* f = faces.begin(static_cast<int>(v)); f != faces.end(static_cast<int>(v)); ++f)
            for (const int w : s.triangles[*f])
                EXPECT_LE(arrivals[v].distance, arrivals[w].distance + (s.points[v] - s.points[w]).norm() + 1e-12);
    }
}

TEST(FastMarching, ArrivalRepeatsTheMarch)
{
    const Surface s = load("elephant.off");
    const VertexFaces faces = around(s);
    const SurfacePoint source{10, s.points[s.triangles[10][1]]};
    const std::vector<Arrival> marched = march(s, faces, source);
    std::vector<double> known(s.points.size());
    for (int v = 0; v < static_cast<int>(marched.size()); ++v) {
        if (std::count(s.triangles[10].begin(), s.triangles[10].end(), v) > 0)
            continue;
        for (std::size_t w = 0; w < known.size(); ++w)
            known[w] = marched[w].distance <= marched[v].distance ? marched[w].distance : INFINITY;
        known[v] = INFINITY;
        const Arrival again = arrival(s, faces, known, v, s.points[v]);
        ASSERT_NEAR(again.distance, marched[v].distance, 1e-14);
        ASSERT_LT((again.gradient - marched[v].gradient).norm(), 1e-6);
    }
}

TEST(FastMarching, OtherPartsAreNeverReached)
{
    Surface s = shapes::box(1, 1, 1);
    const Surface other = shapes::moved(shapes::box(1, 1, 1), 1, 0, {1, 0, 0}, {5, 0, 0});
    for (const Triangle& t : other.triangles)
        s.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
    s.points.insert(s.points.end(), other.points.begin(), other.points.end());
    const std::vector<Arrival> arrivals = march(s, around(s), {0, {0.3, 0.4, 0}});
    for (int v = 0; v < 16; ++v)
        EXPECT_EQ(std::isinf(arrivals[v].distance), v >= 8);
}

TEST(FastMarching, DoesNotDependOnTheNumbering)
{
    const Surface s = load("elephant.off");
    const Point centre = s.points[17];
    const Surface t = shapes::renumbered(s, 5);
    const std::vector<Arrival> a = march(s, around(s), *farthest_hit(s, centre, {1, 2, 3}));
    const std::vector<Arrival> b = march(t, around(t), *farthest_hit(t, centre, {1, 2, 3}));
    const auto farthest = [](const std::vector<Arrival>& arrivals) {
        std::vector<double> d;
        for (const Arrival& arrival : arrivals)
            d.push_back(arrival.distance);
        std::sort(d.begin(), d.end());
        return d;
    };
    const std::vector<double> da = farthest(a);
    const std::vector<double> db = farthest(b);
    for (std::size_t i = 0; i < da.size(); ++i)
        ASSERT_NEAR(da[i], db[i], 1e-12);
}

} // namespace
