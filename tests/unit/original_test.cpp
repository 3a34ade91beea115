// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/watermark/original.h"

#include "support/load.h"
#include "support/shapes.h"
#include "vcg_ext/attack/attack.h"
#include "vcg_ext/base/error.h"
#include "vcg_ext/base/parallel.h"
#include "vcg_ext/watermark/watermark.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

const Key& key()
{
    static const Key one("with the original");
    return one;
}

DetectOptions asking(Method method)
{
    DetectOptions options;
    options.carriers.method = method;
    options.expected = {read_message("id:4711")};
    return options;
}

Surface marked(const Surface& original, Method method)
{
    Surface surface = original;
    EmbedOptions options;
    options.carriers.method = method;
    options.message = read_message("id:4711");
    (void)embed(surface, key(), options);
    return surface;
}

void attack(Surface& surface, Attack what, double amount = -1, int iterations = -1)
{
    AttackOptions options;
    options.attack = what;
    options.amount = amount;
    options.iterations = iterations;
    options.seed = 3;
    (void)apply_attack(surface, options);
}

const Surface& fandisk()
{
    static const Surface mesh = load("fandisk.off");
    return mesh;
}

const Surface& marked_fandisk()
{
    static const Surface mesh = marked(fandisk(), Method::Waves);
    return mesh;
}

} // namespace

TEST(WithOriginal, ReadsHalfOfAMarkedMesh)
{
    Surface suspect = marked_fandisk();
    attack(suspect, Attack::Crop, 0.5);
    attack(suspect, Attack::Noise, 0.001);
    attack(suspect, Attack::Similarity);
    const DetectReport found = detect_with_original(suspect, fandisk(), key(), asking(Method::Waves));
    EXPECT_LT(*found.p_value, 1e-6);
    EXPECT_EQ(found.finding, Verdict::Present);
    ASSERT_TRUE(found.registration);
    EXPECT_TRUE(found.registration->found);
    EXPECT_GT(found.registration->overlap, 0.97);
    EXPECT_LT(found.registration->residual, 1e-3);
    EXPECT_FALSE(found.registration->mirrored);
}

TEST(WithOriginal, ReadsAStretchedAndSmoothedMirrorImage)
{
    Surface suspect = marked_fandisk();
    attack(suspect, Attack::Smooth, 0.5, 20);
    attack(suspect, Attack::Affine, 0.05);
    for (Point& p : suspect.points)
        p.y() = -p.y();
    const DetectReport found = detect_with_original(suspect, fandisk(), key(), asking(Method::Waves));
    EXPECT_LT(*found.p_value, 1e-6);
    EXPECT_TRUE(found.registration->mirrored);
    EXPECT_GT(found.registration->stretch, 0.01);
    EXPECT_EQ(found.smoothing_rounds.value_or(0), 20);
}

TEST(WithOriginal, AnotherKeyOrNoMarkProvesNothing)
{
    Surface suspect = marked_fandisk();
    attack(suspect, Attack::Crop, 0.3);
    const DetectReport other = detect_with_original(suspect, fandisk(), Key("another"), asking(Method::Waves));
    EXPECT_GT(*other.p_value, 1e-3);
    EXPECT_NE(other.finding, Verdict::Present);

    Surface unmarked = fandisk();
    attack(unmarked, Attack::Noise, 0.001);
    const DetectReport none = detect_with_original(unmarked, fandisk(), key(), asking(Method::Waves));
    EXPECT_GT(*none.p_value, 1e-3);
    EXPECT_EQ(none.finding, Verdict::NotFound);
    EXPECT_GT(*detect_with_original(fandisk(), fandisk(), key(), asking(Method::Waves)).p_value, 1e-3);
}

TEST(WithOriginal, ReadsNormsInTheOriginalsFrame)
{
    const Surface original = load("bunny00.off");
    Surface suspect = marked(original, Method::LM);
    attack(suspect, Attack::Crop, 0.3);
    EXPECT_GT(*detect(suspect, key(), asking(Method::LM)).p_value, 1e-3);
    const DetectReport found = detect_with_original(suspect, original, key(), asking(Method::LM));
    EXPECT_LT(*found.p_value, 1e-6);
    EXPECT_GT(*found.detection_ratio, 0.9);
}

/// What a piece of the mesh still says under its own frame, and in the original's.
void expect_read_from_a_piece(Method method)
{
    const Surface original = load("bunny00.off");
    Surface suspect = marked(original, method);
    attack(suspect, Attack::Crop, 0.3);
    DetectOptions options = asking(method);
    options.carriers.bits = 64;
    EXPECT_GT(*detect(suspect, key(), options).p_value, 1e-3) << name(method);
    EXPECT_LT(*detect_with_original(suspect, original, key(), options).p_value, 1e-6) << name(method);
    EXPECT_GT(*detect_with_original(suspect, original, Key("another"), options).p_value, 1e-3) << name(method);
}

TEST(WithOriginal, ReadsStripsOfAPiece)
{
    expect_read_from_a_piece(Method::Geodesic);
}

TEST(WithOriginal, ReadsPatchesOfAPiece)
{
    expect_read_from_a_piece(Method::Spectral);
}

TEST(WithOriginal, FindsThePartThatIsACopy)
{
    Surface plate = load("pig.off");
    const double size = bounding_diagonal(fandisk()) / bounding_diagonal(plate);
    for (Point& p : plate.points)
        p = size * p + Point(2 * bounding_diagonal(fandisk()), 0, 0);
    const Surface copy = shapes::moved(marked_fandisk(), 1, 0.7, Point(1, 1, 0), Point(0, 1, 0));
    const int before = static_cast<int>(plate.points.size());
    plate.points.insert(plate.points.end(), copy.points.begin(), copy.points.end());
    for (const Triangle& t : copy.triangles)
        plate.triangles.push_back({t[0] + before, t[1] + before, t[2] + before});
    const DetectReport found = detect_with_original(plate, fandisk(), key(), asking(Method::Waves));
    EXPECT_EQ(found.finding, Verdict::Present) << found.verdict;
    EXPECT_EQ(found.verdict.substr(0, 5), "part ");
    ASSERT_GE(found.parts.size(), 2U);
    int copies = 0;
    for (const PartReport& part : found.parts)
        copies += part.registration->found;
    EXPECT_EQ(copies, 1);
}

TEST(WithOriginal, IsNoWorseThanTheKeyAlone)
{
    Surface suspect = marked_fandisk();
    attack(suspect, Attack::Simplify, 0.95);
    const DetectReport alone = detect(suspect, key(), asking(Method::Waves));
    const DetectReport found = detect_with_original(suspect, fandisk(), key(), asking(Method::Waves));
    EXPECT_LT(*alone.p_value, 1e-6);
    EXPECT_LE(*found.p_value, 5.001 * *alone.p_value);
    EXPECT_EQ(found.verdict.substr(0, 17), "by the key alone:") << found.verdict;
    EXPECT_TRUE(found.registration && found.registration->found);
}

std::string refusal_of(const Surface& suspect, const Surface& original, const DetectOptions& options)
{
    try {
        (void)detect_with_original(suspect, original, key(), options);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(WithOriginal, RefusesAnOriginalThatIsMarked)
{
    Surface suspect = fandisk();
    attack(suspect, Attack::Noise, 0.0005);
    EXPECT_NE(refusal_of(suspect, marked_fandisk(), asking(Method::Waves)).find("carries a mark"), std::string::npos);
}

TEST(WithOriginal, RefusesAnOriginalThatIsMarkedWithAnyNumberOfBits)
{
    EmbedOptions options;
    options.carriers.method = Method::LM;
    options.message = read_message("museum"); // 96 carriers
    Surface original = fandisk();
    (void)embed(original, key(), options);
    DetectOptions blind;
    blind.carriers.method = Method::LM;
    EXPECT_NE(refusal_of(fandisk(), original, blind).find("carries a mark"), std::string::npos);
}

TEST(WithOriginal, ReadsNothingByARoundOriginal)
{
    Surface lathe = shapes::sphere(3);
    for (Point& p : lathe.points)
        p[2] = 1.6 * p[2] + 0.3 * p[2] * p[2];
    const Surface suspect = shapes::moved(lathe, 1.01, 0.3, Point(0, 1, 0), Point(1, 0, 0));
    const DetectReport found = detect_with_original(suspect, lathe, key(), asking(Method::Waves));
    EXPECT_EQ(found.finding, Verdict::NotFound) << found.verdict;
    EXPECT_GT(*found.p_value, 1e-3);
}

TEST(WithOriginal, SaysWhereAMeshIsNoCopy)
{
    const DetectReport found = detect_with_original(load("pig.off"), fandisk(), key(), asking(Method::Waves));
    EXPECT_EQ(found.finding, Verdict::NotFound);
    EXPECT_EQ(*found.p_value, 1);
    EXPECT_FALSE(found.registration->found);
    EXPECT_NE(found.verdict.find("not a copy of this original"), std::string::npos) << found.verdict;
}

TEST(WithOriginal, IsCancelledAndRefusesBadInput)
{
    const auto stop = [](int percent, const char*) { return percent < 40; };
    EXPECT_THROW((void)detect_with_original(marked_fandisk(), fandisk(), key(), asking(Method::Waves), stop),
                 Cancelled);
    EXPECT_THROW((void)detect_with_original(fandisk(), {}, key(), asking(Method::Waves)), Error);
    EXPECT_THROW((void)detect_with_original({}, fandisk(), key(), asking(Method::Waves)), Error);
}

TEST(WithOriginal, IsTheSameAtAnyNumberOfThreads)
{
    Surface suspect = marked_fandisk();
    attack(suspect, Attack::Noise, 0.001);
    set_threads(1);
    const DetectReport one = detect_with_original(suspect, fandisk(), key(), asking(Method::Waves));
    set_threads(3);
    const DetectReport three = detect_with_original(suspect, fandisk(), key(), asking(Method::Waves));
    set_threads(0);
    EXPECT_EQ(one.soft, three.soft);
    EXPECT_EQ(one.p_value, three.p_value);
}
