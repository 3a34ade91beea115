// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/load.h"
#include "support/shapes.h"
#include "vcg_ext/base/parallel.h"
#include "vcg_ext/key/key.h"
#include "vcg_ext/key/stream.h"
#include "vcg_ext/placement/fold_guard.h"

#include <algorithm>
#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

/// Moves that fold about a third of the faces: up to a whole edge length, from a keyed stream.
Points shaken(const Surface& surface, double length)
{
    Stream stream = Key("shaken").stream("test");
    Points points = surface.points;
    for (Point& p : points)
        for (int axis = 0; axis < 3; ++axis)
            p[axis] += length * (static_cast<double>(stream.below(2001)) / 1000 - 1);
    return points;
}

TEST(GuardFolds, LeavesNoFaceFolded)
{
    const Surface surface = load("fandisk.off");
    const Cover cover(surface);
    Points points = shaken(surface, 0.01 * bounding_diagonal(surface));
    const Points best = points;
    const auto retreat = [&](int v, int step) -> Point {
        return surface.points[v] + (best[v] - surface.points[v]) / (1 << step);
    };
    ASSERT_FALSE(folded_faces(cover, points).empty());
    const Moves back = guard_folds(cover, points, 6, retreat);
    EXPECT_TRUE(folded_faces(cover, points).empty());

    EXPECT_GT(back.vertices.size(), 0);
    EXPECT_LT(back.vertices.size(), points.size());
    Points undone = points;
    take_back(back, undone);
    EXPECT_EQ(undone, best); // so all others stay where they were placed
    for (const int v : back.vertices) {
        bool on_its_way = points[v] == surface.points[v];
        for (int step = 1; step < 6; ++step)
            on_its_way |= points[v] == retreat(v, step);
        EXPECT_TRUE(on_its_way);
    }
}

TEST(GuardFolds, EndsTheSameOnAnyNumberOfThreads)
{
    const Surface surface = load("bunny00.off");
    const Cover cover(surface);
    const Points best = shaken(surface, 0.005 * bounding_diagonal(surface));
    const auto guarded = [&](int threads) {
        set_threads(threads);
        Points points = best;
        const Moves back = guard_folds(cover, points, 6, [&](int v, int s) -> Point {
            return surface.points[v] + (best[v] - surface.points[v]) / (1 << s);
        });
        set_threads(0);
        EXPECT_GT(back.vertices.size(), 10000); // more than one chunk
        return points;
    };
    EXPECT_EQ(guarded(1), guarded(4));
}

TEST(FoldedFaces, AreThoseOfAllWhereOnlySomeVerticesMoved)
{
    const Surface surface = load("fandisk.off");
    const Cover cover(surface);
    const Points all = shaken(surface, 0.01 * bounding_diagonal(surface));
    Points points = surface.points;
    std::vector<int> known;
    for (const int step : {20, 30}) { // those that are moved the second time, and those that go back
        std::vector<int> moved;
        for (int v = 0; v < static_cast<int>(points.size()); v += step) {
            points[v] = v % 60 == 0 && step == 30 ? surface.points[v] : all[v];
            moved.push_back(v);
        }
        known = folded_faces(cover, points, known, moved);
        std::sort(known.begin(), known.end());
        EXPECT_EQ(known, folded_faces(cover, points));
        EXPECT_FALSE(known.empty());
    }
}

TEST(GuardFolds, LeavesGoodMovesAlone)
{
    const Surface surface = load("fandisk.off");
    const Cover cover(surface);
    Points points = surface.points;
    for (Point& p : points)
        p *= 1.1;
    const Points scaled = points;
    const auto never = [](int, int) -> Point { throw std::logic_error("no step is due"); };
    EXPECT_TRUE(guard_folds(cover, points, 6, never).vertices.empty());
    EXPECT_EQ(points, scaled);
}

TEST(Moves, JoinedAreTakenBackAtOnce)
{
    Stream stream = Key("moves").stream("test");
    const Points before(100, Point(1, 2, 3));
    Points points = before;
    const auto move_some = [&] {
        Moves moves;
        for (int v = 0; v < 100; ++v)
            if (stream.below(3) == 0) {
                moves.vertices.push_back(v);
                moves.before.push_back(points[v]);
                points[v] += Point(1, 0, static_cast<double>(stream.below(10)));
            }
        return moves;
    };
    const Moves first = move_some();
    const Moves second = move_some();
    const Moves both = joined(first, second);
    EXPECT_TRUE(std::is_sorted(both.vertices.begin(), both.vertices.end()));
    EXPECT_LT(both.vertices.size(), first.vertices.size() + second.vertices.size());
    take_back(both, points);
    EXPECT_EQ(points, before);
}

TEST(Folded, SeesATurnAndAFlatteningButNoFaceWithoutAnArea)
{
    const Surface surface{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 1, 3}}};
    const Cover cover(surface);
    const double cos59 = 0.515, cos61 = 0.485;
    EXPECT_FALSE(folded(cover, 0, Point(std::sqrt(1 - cos59 * cos59), 0, cos59)));
    EXPECT_TRUE(folded(cover, 0, Point(std::sqrt(1 - cos61 * cos61), 0, cos61)));
    EXPECT_FALSE(folded(cover, 0, Point(0, 0, 0.06)));
    EXPECT_TRUE(folded(cover, 0, Point(0, 0, 0.04)));
    EXPECT_FALSE(folded(cover, 1, Point(0, 0, -1)));
}

TEST(Folded, OneVertexSeesWhatAllFacesDo)
{
    const Surface ball = shapes::sphere(3);
    const Cover cover(ball);
    int folds = 0;
    for (int v = 0; v < static_cast<int>(ball.points.size()); v += 7) {
        Points moved = ball.points;
        moved[v] *= 1 - 0.01 * (v % 20);
        EXPECT_EQ(folds_around(cover, ball.points, v, moved[v]), !folded_faces(cover, moved).empty());
        folds += folds_around(cover, ball.points, v, moved[v]);
    }
    EXPECT_GT(folds, 5);
}

} // namespace
