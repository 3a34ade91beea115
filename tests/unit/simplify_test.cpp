// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/attack/simplify.h"
#include "vcg_ext/base/weld.h"

#include "support/load.h"
#include "support/shapes.h"
#include "vcg_ext/geometry/closest.h"
#include "vcg_ext/geometry/moments.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

TEST(Simplify, ReachesTheNumberOfFaces)
{
    const Surface disk = load("fandisk.off");
    for (const int faces : {6473, 1295, 130}) {
        const int left = static_cast<int>(simplify(disk, faces).triangles.size());
        EXPECT_LE(left, faces);
        EXPECT_GE(left, faces - 2);
    }
}

TEST(Simplify, FlatSidesLoseNothing)
{
    // A box cut into many faces: its planes' quadrics are zero on its sides, so the shape stays to the last.
    Surface box = shapes::box(1, 2, 3);
    for (int i = 0; i < 3; ++i) {
        Surface finer;
        for (const Triangle& t : box.triangles) {
            const Point m[3] = {(box.points[t[0]] + box.points[t[1]]) / 2, (box.points[t[1]] + box.points[t[2]]) / 2,
                                (box.points[t[2]] + box.points[t[0]]) / 2};
            const Point* c[3] = {&box.points[t[0]], &box.points[t[1]], &box.points[t[2]]};
            const Points all = {*c[0], *c[1], *c[2], m[0], m[1], m[2]};
            const int first = static_cast<int>(finer.points.size());
            finer.points.insert(finer.points.end(), all.begin(), all.end());
            for (const Triangle& s : {Triangle{0, 3, 5}, Triangle{3, 1, 4}, Triangle{5, 4, 2}, Triangle{3, 4, 5}})
                finer.triangles.push_back({s[0] + first, s[1] + first, s[2] + first});
        }
        box = weld(finer).surface;
    }
    ASSERT_EQ(box.triangles.size(), 768u);
    const Surface simple = simplify(box, 76);
    EXPECT_NEAR(signed_volume(simple), 6, 1e-9);
}

TEST(Simplify, StaysNearTheSurface)
{
    const Surface disk = load("fandisk.off");
    const ClosestSearch nearest(disk);
    const double diagonal = bounding_diagonal(disk);
    for (const Point& p : simplify(disk, 6473).points)
        EXPECT_LT(nearest(p).distance, 2e-3 * diagonal);
}

} // namespace
