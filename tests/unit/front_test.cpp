// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/load.h"
#include "support/march.h"
#include "support/shapes.h"
#include "vcg_ext/base/parallel.h"
#include "vcg_ext/placement/fold_guard.h"
#include "vcg_ext/placement/front.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Setting {
    explicit Setting(const Surface& s, const Point& origin = Point::Zero(), const Point& direction = {0.3, 0.4, 0.5})
        : surface(s), cover(surface), source(*farthest_hit(surface, origin, direction)),
          arrivals(march(surface, cover.around, source)), targets(surface.points.size(), nan)
    {
    }

    /// Pushes the distances beyond `from` to and fro by up to `amplitude`, in waves of the length `wave`.
    void wave(double from, double amplitude, double wave)
    {
        for (std::size_t v = 0; v < targets.size(); ++v) {
            const double t = arrivals[v].distance;
            if (t > from)
                targets[v] = t + amplitude * std::sin(t / wave);
        }
    }

    [[nodiscard]] std::vector<double> misses(const Points& points) const
    {
        const std::vector<Arrival> now = march({points, surface.triangles}, cover.around, source);
        std::vector<double> result;
        for (std::size_t v = 0; v < targets.size(); ++v)
            if (!std::isnan(targets[v]))
                result.push_back(std::abs(now[v].distance - targets[v]));
        return result;
    }

    Surface surface;
    Cover cover;
    SurfacePoint source;
    std::vector<Arrival> arrivals;
    std::vector<double> targets;
};

class EveryScheme : public testing::TestWithParam<FrontScheme> {};

TEST_P(EveryScheme, AFreshMarchFindsEachVertexAtItsTarget)
{
    Setting setting(shapes::sphere(5));
    setting.wave(0.3, 0.01, 0.02);
    constexpr double tolerance = 1e-5;
    const FrontPlacement placed =
        place_front(setting.cover, setting.arrivals, setting.targets, tolerance, {GetParam()});
    const std::vector<double> misses = setting.misses(placed.points);
    const auto far = std::count_if(misses.begin(), misses.end(), [](double miss) { return miss > 2 * tolerance; });
    EXPECT_LE(far, static_cast<long>(misses.size()) / 500);
    EXPECT_LE(placed.counts.unconverged, static_cast<int>(misses.size()) / 500);
    EXPECT_LE(placed.counts.total(), static_cast<int>(misses.size()));
    EXPECT_GE(placed.counts.total(), static_cast<int>(misses.size()) * 9 / 10);
}

TEST_P(EveryScheme, OnAPlaneMovesAlongTheFrontInThePlane)
{
    Setting setting(shapes::triangular_grid(6, 6, 0.1), {3.02, 3.03, -1}, {0, 0, 1});
    setting.wave(0.5, 0.01, 0.05);
    const FrontPlacement placed = place_front(setting.cover, setting.arrivals, setting.targets, 1e-7, {GetParam()});
    for (std::size_t v = 0; v < placed.points.size(); ++v) {
        const Point way = setting.surface.points[v] - setting.source.position;
        const double radius = way.norm();
        if (radius > 2.5)
            continue; // straight lines leave the grid at its jagged border
        const double target = std::isnan(setting.targets[v]) ? radius : setting.targets[v];
        EXPECT_NEAR(placed.points[v].z(), 0, 1e-15);
        // Theorem 1: along the gradient by the difference of distances.
        EXPECT_LT((placed.points[v] - (setting.source.position + target * way.normalized())).norm(), 1e-3 * radius);
    }
}

TEST_P(EveryScheme, FoldsNothingHoweverFarTheTargets)
{
    Setting setting(load("elephant.off"), load("elephant.off").points[0]);
    const double size = bounding_diagonal(setting.surface);
    setting.wave(0.1 * size, 0.05 * size, 0.01 * size);
    const FrontPlacement placed =
        place_front(setting.cover, setting.arrivals, setting.targets, 1e-5 * size, {GetParam()});
    EXPECT_TRUE(folded_faces(setting.cover, placed.points).empty());
    EXPECT_GT(placed.counts.unconverged, 0);
}

TEST_P(EveryScheme, MovesNothingThatHasNoTargetOrIsThere)
{
    Setting setting(shapes::sphere(4));
    setting.wave(1, 0.01, 0.1);
    for (std::size_t v = 0; v < setting.targets.size(); ++v)
        if (setting.arrivals[v].distance > 2)
            setting.targets[v] = nan;
    const FrontPlacement placed = place_front(setting.cover, setting.arrivals, setting.targets, 1e-6, {GetParam()});
    for (std::size_t v = 0; v < setting.targets.size(); ++v)
        if (std::isnan(setting.targets[v])) {
            EXPECT_EQ(placed.points[v], setting.surface.points[v]);
        }
    for (std::size_t v = 0; v < setting.targets.size(); ++v)
        setting.targets[v] = setting.arrivals[v].distance;
    for (const int v : setting.surface.triangles[setting.source.face])
        setting.targets[v] = nan;
    const FrontPlacement nowhere = place_front(setting.cover, setting.arrivals, setting.targets, 1e-6, {GetParam()});
    EXPECT_EQ(nowhere.counts.total(), 0);
    EXPECT_EQ(nowhere.points, setting.surface.points);
}

TEST_P(EveryScheme, IsTheSameAtAnyNumberOfThreads)
{
    Setting setting(shapes::sphere(4));
    setting.wave(0.3, 0.03, 0.05);
    const auto place = [&](int threads) {
        set_threads(threads);
        const FrontPlacement placed = place_front(setting.cover, setting.arrivals, setting.targets, 1e-6, {GetParam()});
        set_threads(0);
        return placed;
    };
    const FrontPlacement one = place(1);
    const FrontPlacement four = place(4);
    EXPECT_EQ(one.points, four.points);
    EXPECT_EQ(one.counts.moves, four.counts.moves);
}

INSTANTIATE_TEST_SUITE_P(Front, EveryScheme, testing::Values(FrontScheme::PredictCorrect, FrontScheme::Sequential),
                         [](const auto& info) {
                             return info.param == FrontScheme::PredictCorrect ? "PredictCorrect" : "Sequential";
                         });

TEST(Front, PredictingCostsLessDistanceFromTheSurfaceThanFollowing)
{
    // A sheet bent by a right angle: across the edge the front must leave the surface.
    const Surface bent = [] {
        Surface s = shapes::triangular_grid(4, 4, 0.1);
        for (Point& p : s.points)
            if (p.x() > 2)
                p = Point(2, p.y(), 2 - p.x());
        return s;
    }();
    Setting setting(bent, {1.02, 1.03, -1}, {0, 0, 1});
    setting.wave(0.4, 0.005, 0.05);
    const auto off_surface = [&](FrontScheme scheme) {
        const FrontPlacement placed = place_front(setting.cover, setting.arrivals, setting.targets, 1e-6, {scheme});
        double sum = 0;
        for (const Point& p : placed.points) // the bent sheet is where x = 2 or z = 0
            sum += std::pow(std::min(std::abs(p.x() - 2), std::abs(p.z())), 2);
        return sum;
    };
    EXPECT_LT(off_surface(FrontScheme::PredictCorrect), off_surface(FrontScheme::Sequential) / 2);
}

TEST(FrontMobility, IsOneOnAPlaneAndAlongAnEdgeAndSmallAcross)
{
    Surface s = shapes::triangular_grid(4, 4, 0.1);
    const int columns = 41;
    const double fold = s.points[20 * columns].y(); // along a row of the grid
    for (Point& p : s.points)
        if (p.y() > fold)
            p = Point(p.x(), fold, fold - p.y());
    const Cover cover(s);
    const auto mobility = [&](const Point& gradient) {
        std::vector<Arrival> arrivals(s.points.size(), Arrival{1, gradient});
        return front_mobility(cover, arrivals);
    };
    const int on_plane = 5 * columns + 20;
    const int on_edge = 20 * columns + 20;
    EXPECT_NEAR(mobility({0, 1, 0})[on_plane], 1, 1e-9);
    EXPECT_NEAR(mobility({1, 0, 0})[on_edge], 1, 1e-9);
    EXPECT_LT(mobility({0, 1, 0})[on_edge], 0.05);
}

} // namespace
