// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/attack/attack.h"
#include "vcg_ext/base/error.h"
#include "vcg_ext/base/progress.h"
#include "vcg_ext/base/weld.h"

#include "support/load.h"
#include "support/shapes.h"
#include "support/topology.h"
#include "vcg_ext/base/parallel.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

using namespace vcg_ext;

namespace {

/// Weak and quick, but each does something.
AttackOptions options(Attack attack)
{
    AttackOptions result;
    result.attack = attack;
    result.seed = 11;
    if (attack == Attack::Isosurface)
        result.amount = 0.03;
    if (range(attack).iterations > 0)
        result.iterations = 2;
    return result;
}

TEST(Attack, EachHasItsOwnName)
{
    std::set<std::string> names;
    for (const Attack attack : all_attacks())
        names.insert(name(attack));
    EXPECT_EQ(names.size(), 17u);
    EXPECT_EQ(std::string(name(Attack::Plate)), "Plate");
}

TEST(Attack, SaysWhatItLeft)
{
    for (const Attack attack : all_attacks()) {
        Surface surface = shapes::sphere(3);
        const Surface before = surface;
        const AttackReport r = apply_attack(surface, options(attack));
        EXPECT_EQ(r.vertices, static_cast<int>(surface.points.size())) << name(attack);
        EXPECT_EQ(r.faces, static_cast<int>(surface.triangles.size())) << name(attack);
        EXPECT_EQ(r.amount, attack == Attack::Isosurface ? 0.03 : range(attack).amount) << name(attack);
        EXPECT_EQ(r.seed, 11u);
        if (r.positions_only) {
            EXPECT_EQ(surface.triangles, before.triangles) << name(attack);
        }
        EXPECT_TRUE(surface.points != before.points) << name(attack);
    }
}

TEST(Attack, SameAnswerAgainAndAtAnyNumberOfThreads)
{
    for (const Attack attack : all_attacks()) {
        const Surface start = load("fandisk.off");
        Surface first = start;
        set_threads(1);
        apply_attack(first, options(attack));
        for (const int threads : {1, 3}) {
            set_threads(threads);
            Surface again = start;
            apply_attack(again, options(attack));
            EXPECT_EQ(again.points, first.points) << name(attack);
            EXPECT_EQ(again.triangles, first.triangles) << name(attack);
        }
    }
    set_threads(0);
}

TEST(Attack, SoupStaysClosed)
{
    for (const Attack attack : all_attacks()) {
        if (attack == Attack::Crop)
            continue;
        Surface faces = soup(shapes::sphere(3));
        const std::size_t vertices = faces.points.size();
        const AttackReport r = apply_attack(faces, options(attack));
        if (r.positions_only) {
            EXPECT_EQ(faces.points.size(), vertices) << name(attack);
        }
        EXPECT_TRUE(is_closed_manifold(weld(faces).surface)) << name(attack);
    }
}

TEST(Attack, NamesTheRangeItRefuses)
{
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    for (const Attack attack : all_attacks()) {
        const AttackRange& allowed = range(attack);
        Surface surface = shapes::sphere(1);
        const Surface before = surface;
        AttackOptions wrong = options(attack);
        if (allowed.amount_is)
            for (const double amount : {allowed.most * 1.01 + 1, -0.5, nothing}) {
                wrong.amount = amount;
                try {
                    apply_attack(surface, wrong);
                    ADD_FAILURE() << name(attack) << " took " << amount;
                } catch (const Error& error) {
                    EXPECT_NE(std::string(error.what()).find("between"), std::string::npos) << error.what();
                }
            }
        wrong = options(attack);
        if (allowed.iterations > 0)
            for (const int iterations : {0, -2, allowed.most_iterations + 1}) {
                wrong.iterations = iterations;
                EXPECT_THROW(apply_attack(surface, wrong), Error) << name(attack);
            }
        EXPECT_EQ(surface.points, before.points);
    }
    Surface surface = shapes::sphere(1);
    EXPECT_THROW(apply_attack(surface, {Attack::Quantize, 7.5, -1, 0}), Error);
}

TEST(Attack, RefusesWhatIsNoSurface)
{
    Surface nothing;
    Surface points = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}};
    Surface collapsed = {{{0, 0, 0}, {0, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    Surface infinite = shapes::sphere(0);
    infinite.points[3].x() = std::numeric_limits<double>::infinity();
    for (const Attack attack : all_attacks())
        for (Surface* surface : {&nothing, &points, &collapsed, &infinite})
            EXPECT_THROW(apply_attack(*surface, options(attack)), Error) << name(attack);
}

TEST(Attack, CancelledLeavesTheMesh)
{
    for (const Attack attack : all_attacks()) {
        Surface surface = shapes::sphere(2);
        const Surface before = surface;
        EXPECT_THROW(apply_attack(surface, options(attack), [](int percent, const char*) { return percent < 100; }),
                     Cancelled);
        EXPECT_EQ(surface.points, before.points);
        EXPECT_EQ(surface.triangles, before.triangles);
    }
}

} // namespace
