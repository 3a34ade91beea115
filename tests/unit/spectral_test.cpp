// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/load.h"
#include "vcg_ext/attack/attack.h"
#include "vcg_ext/base/parallel.h"
#include "vcg_ext/payload/binomial.h"
#include "vcg_ext/watermark/watermark.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace {

using namespace vcg_ext;

EmbedOptions spectral(int bits)
{
    EmbedOptions options;
    options.carriers.method = Method::Spectral;
    options.carriers.bits = bits;
    options.message = {Kind::Bits, Bits(bits, 0), {}};
    for (int i = 0; i < bits; ++i)
        options.message.bits[i] = static_cast<std::uint8_t>(i * i / 3 % 2);
    return options;
}

DetectOptions reading_of(const EmbedOptions& embedded)
{
    DetectOptions options;
    options.carriers = embedded.carriers;
    return options;
}

/// A body with three planes of symmetry, bumpy: an octahedron's faces, `n` times cut, on an ellipsoid.
Surface symmetric_body(int n)
{
    Surface body{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                 {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
    AttackOptions cut;
    cut.attack = Attack::Subdivide;
    cut.iterations = n;
    (void)apply_attack(body, cut);
    for (Point& p : body.points)
        p = (p.normalized() * (1 + 0.01 * std::cos(25 * p.normalized().x()))).cwiseProduct(Point(3, 2, 1.2));
    return body;
}

TEST(Spectral, IsReadBackAfterSimilarityAndRenumbering)
{
    for (const char* mesh : {"armadillo.off", "fandisk.off"}) {
        const EmbedOptions options = spectral(64);
        const Key key(mesh);
        const Surface cover = load(mesh);
        Surface marked = cover;
        const EmbedReport embedded = embed(marked, key, options);
        EXPECT_EQ(embedded.detection_ratio, 1);
        EXPECT_EQ(embedded.warnings.size(), 0u);
        EXPECT_EQ(detect(marked, key, reading_of(options)).bits, options.message.bits);
        (void)apply_attack(marked, {Attack::Similarity, -1, -1, 3});
        (void)apply_attack(marked, {Attack::Reorder, -1, -1, 4});
        EXPECT_EQ(detect(marked, key, reading_of(options)).bits, options.message.bits);
    }
}

TEST(Spectral, FoldsNoFace)
{
    const Surface cover = load("armadillo.off");
    Surface marked = cover;
    (void)embed(marked, Key("folds"), spectral(64));
    for (const Triangle& t : cover.triangles)
        EXPECT_GE(scaled_normal(cover.points, t).dot(scaled_normal(marked.points, t)), 0);
}

TEST(Spectral, IsTheSameAtAnyNumberOfThreads)
{
    const EmbedOptions options = spectral(32);
    const Key key("threads");
    Surface one = load("fandisk.off");
    Surface four = one;
    set_threads(1);
    (void)embed(one, key, options);
    const std::vector<double> soft = detect(one, key, reading_of(options)).soft;
    set_threads(4);
    (void)embed(four, key, options);
    EXPECT_EQ(one.points, four.points);
    EXPECT_EQ(soft, detect(four, key, reading_of(options)).soft);
    set_threads(0);
}

TEST(Spectral, ASymmetricBodyIsReadWhicheverWayItLies)
{
    // Its third moments are what embedding and noise left: the frame's signs are a matter of chance.
    const EmbedOptions options = spectral(32);
    const Key key("symmetric body");
    Surface marked = symmetric_body(5);
    const EmbedReport embedded = embed(marked, key, options);
    EXPECT_EQ(embedded.detection_ratio, 1);
    DetectOptions reading = reading_of(options);
    std::vector<std::string> seen;
    for (int i = 0; i < 12; ++i) {
        Surface noisy = marked;
        AttackOptions noise;
        noise.attack = Attack::Noise;
        noise.amount = 0.0005;
        noise.seed = static_cast<std::uint64_t>(i);
        (void)apply_attack(noisy, noise);
        // A push to one side outweighs what embedding left.
        for (Point& p : noisy.points)
            p += Point((i & 1) ? 1e-4 : -1e-4, (i & 2) ? 1e-4 : -1e-4, 0).cwiseProduct(p).cwiseProduct(p);
        const DetectReport blind = detect(noisy, key, reading);
        EXPECT_EQ(blind.bits, options.message.bits) << i;
        reading.expected = {options.message};
        EXPECT_EQ(*detect(noisy, key, reading).detection_ratio, 1) << i;
        reading.expected.clear();
        seen.push_back(blind.orientation);
    }
    std::sort(seen.begin(), seen.end());
    EXPECT_EQ(std::unique(seen.begin(), seen.end()) - seen.begin(), 4);
}

TEST(Spectral, TheChanceOfAWrongKeyIsFourTails)
{
    const EmbedOptions options = spectral(64);
    Surface marked = load("fandisk.off");
    (void)embed(marked, Key("right"), options);
    DetectOptions reading = reading_of(options);
    reading.expected = {options.message};
    const DetectReport right = detect(marked, Key("right"), reading);
    EXPECT_DOUBLE_EQ(*right.p_binomial, 4 * binomial_tail(64, 64));
    EXPECT_EQ(right.orientation, "++");
    int below = 0;
    const int keys = 20;
    for (int i = 0; i < keys; ++i) {
        const DetectReport wrong = detect(marked, Key("wrong " + std::to_string(i)), reading);
        const int matches = matching_bits(options.message.bits, wrong.bits);
        EXPECT_DOUBLE_EQ(*wrong.p_binomial, std::min(1.0, 4 * binomial_tail(64, matches)));
        below += *wrong.p_value < 0.1;
    }
    EXPECT_LE(below, 7); // of 20 with a chance of at most 0.1 each: more than 7 has a chance of 0.0004
}

TEST(Spectral, WhatReadsBetterThanChanceIsNotSaidToBeUnmarked)
{
    const EmbedOptions options = spectral(12); // all right is 2^-12
    Surface marked = load("fandisk.off");
    const Key key("few");
    (void)embed(marked, key, options);
    DetectOptions reading = reading_of(options);
    reading.expected = {options.message};
    const DetectReport found = detect(marked, key, reading);
    EXPECT_EQ(found.finding, Verdict::NotFound);
    EXPECT_GE(*found.p_value, std::pow(2, -12));
    EXPECT_EQ(found.verdict.find("not found: a message reads better than chance would have it (p 1e-"), 0u)
        << found.verdict << *found.p_value;
    EXPECT_EQ(detect(load("fandisk.off"), key, reading).verdict.find("not found: no mark of this key"), 0u);
}

TEST(Spectral, AsPrintedIsReadBack)
{
    EmbedOptions options = spectral(16);
    options.carriers.as_printed = true;
    Surface marked = load("fandisk.off");
    const Key key("printed");
    EXPECT_EQ(embed(marked, key, options).detection_ratio, 1);
    EXPECT_EQ(detect(marked, key, reading_of(options)).bits, options.message.bits);
}

TEST(Spectral, RefusesWhatItCannotDo)
{
    Surface small = load("anchor.off");
    const Points before = small.points;
    EXPECT_THROW((void)embed(small, Key("k"), spectral(256)), Error); // patches of a few vertices
    EmbedOptions weak = spectral(16);
    weak.placement.strength = 1;
    EXPECT_THROW((void)embed(small, Key("k"), weak), Error);
    EXPECT_EQ(small.points, before);
}

} // namespace
