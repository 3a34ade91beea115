// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/method/certificate.h"

#include "support/load.h"
#include "support/shapes.h"
#include "vcg_ext/attack/attack.h"
#include "vcg_ext/base/parallel.h"
#include "vcg_ext/base/pi.h"
#include "vcg_ext/watermark/watermark.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

const Key& key()
{
    static const Key one("certificate");
    return one;
}

EmbedOptions embedding(Method method)
{
    EmbedOptions options;
    options.carriers.method = method;
    options.message = read_message("id:4711");
    return options;
}

DetectOptions asking(Method method)
{
    return {embedding(method).carriers, {read_message("id:4711")}};
}

const Surface& fandisk()
{
    static const Surface mesh = load("fandisk.off");
    return mesh;
}

const std::string& bytes()
{
    static const std::string made = bytes_of(make_certificate(fandisk(), key(), embedding(Method::Waves)));
    return made;
}

void attack(Surface& surface, Attack what, double amount = -1)
{
    AttackOptions options;
    options.attack = what;
    options.amount = amount;
    options.seed = 3;
    (void)apply_attack(surface, options);
}

std::string refusal_of(const std::string& file)
{
    try {
        (void)certificate_of(file);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

std::string refusal_of(const Key& reader, const DetectOptions& options)
{
    try {
        (void)detect_with_certificate(fandisk(), certificate_of(bytes()), reader, options);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

} // namespace

/// On a sphere the area within a chord d is pi d^2, and what is there lies d^2 / (2 R) below the tangent plane.
TEST(LocalMeans, OfASphereAreThoseOfItsCurvature)
{
    constexpr double r = 0.6;
    const Surface sphere = shapes::sphere(5);
    const Points points = {Point(0, 0, 1), Point(0.6, 0, -0.8), Point(1, 1, 1).normalized()};
    const LocalMeans means = local_means(points, points, r, sphere);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_NEAR(means.masses[i] / (pi * r * r / 3), 1, 1e-2); // of facets
        EXPECT_NEAR(means.offsets[i] / (-r * r / 8), 1, 1e-2);
    }
}

TEST(LocalMeans, DoNotDependOnHowTheSurfaceIsMeshed)
{
    Surface finer = fandisk();
    attack(finer, Attack::Subdivide);
    const Impression impression = certificate_of(bytes()).impression;
    const double r = mean_radius * impression.likeness.size();
    const LocalMeans one = local_means(impression.points, impression.normals, r, fandisk());
    const LocalMeans two = local_means(impression.points, impression.normals, r, finer);
    for (std::size_t i = 0; i < impression.points.size(); ++i) {
        EXPECT_NEAR(one.masses[i] / two.masses[i], 1, 0.02);
        EXPECT_NEAR(one.offsets[i] / r, two.offsets[i] / r, 2e-3);
    }
}

/// The same integral over all pairs of faces and points.
TEST(LocalMeans, LeaveNoFaceOut)
{
    const Surface& mesh = fandisk();
    const Impression impression = impression_of(mesh, 200);
    const double r = 0.3 * impression.likeness.size();
    const LocalMeans got = local_means(impression.points, impression.normals, r, mesh);
    Surface fine = mesh; // no face of it is cut up
    AttackOptions subdivide{Attack::Subdivide, -1, 2};
    (void)apply_attack(fine, subdivide);
    const LocalMeans all = local_means(impression.points, impression.normals, r, fine);
    for (std::size_t i = 0; i < impression.points.size(); ++i) {
        double mass = 0;
        for (const Triangle& t : fine.triangles) {
            const Point n = scaled_normal(fine.points, t);
            const Point middle = (fine.points[t[0]] + fine.points[t[1]] + fine.points[t[2]]) / 3;
            const double u = 1 - (middle - impression.points[i]).squaredNorm() / (r * r);
            if (u > 0 && n.dot(impression.normals[i]) > 0)
                mass += u * u * n.norm() / 2;
        }
        EXPECT_NEAR(all.masses[i], mass, 1e-3 * mass);
        EXPECT_NEAR(got.masses[i], mass, 0.02 * mass);
    }
}

TEST(FarthestPoints, KnowTheNearestOfEach)
{
    const Points& points = fandisk().points;
    const Spread spread = farthest_points(points, 50);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto to = [&](int chosen) { return (points[chosen] - points[i]).squaredNorm(); };
        for (const int other : spread.chosen)
            ASSERT_LE(to(spread.chosen[spread.nearest[i]]), to(other));
    }
}

TEST(Impression, ItsScalesLieOnTheSurface)
{
    const FootSearch scales(scales_of(certificate_of(bytes()).impression));
    const double size = likeness_of(fandisk()).size();
    double sum = 0;
    for (const Point& p : fandisk().points)
        sum += scales(p, size).distance / size / static_cast<double>(fandisk().points.size());
    EXPECT_LT(sum, 0.01);
}

TEST(Certificate, ReadsBackAsItWasWritten)
{
    EXPECT_LT(bytes().size(), 28000U);
    EXPECT_TRUE(bytes_of(certificate_of(bytes())) == bytes());
    set_threads(1);
    EXPECT_TRUE(bytes_of(make_certificate(fandisk(), key(), embedding(Method::Waves))) == bytes());
    set_threads(0);
}

TEST(Certificate, ReadsHalfOfAMarkedMesh)
{
    Surface suspect = fandisk();
    (void)embed(suspect, key(), embedding(Method::Waves));
    attack(suspect, Attack::Crop, 0.5);
    attack(suspect, Attack::Noise, 0.001);
    attack(suspect, Attack::Similarity);
    const DetectReport found = detect_with_certificate(suspect, certificate_of(bytes()), key(), asking(Method::Waves));
    EXPECT_LT(*found.p_value, 1e-6);
    EXPECT_EQ(found.finding, Verdict::Present);
    EXPECT_GT(found.registration->overlap, 0.97);
    EXPECT_LT(found.registration->residual, 1e-3);
    EXPECT_FALSE(found.registration->mirrored);
}

TEST(Certificate, ProvesNothingOfAnUnmarkedMesh)
{
    Surface suspect = fandisk();
    attack(suspect, Attack::Noise, 0.001);
    const DetectReport found = detect_with_certificate(suspect, certificate_of(bytes()), key(), asking(Method::Waves));
    EXPECT_GT(*found.p_value, 1e-3);
    EXPECT_EQ(found.finding, Verdict::NotFound);
}

TEST(Certificate, TellsAMeshThatIsNoCopy)
{
    const DetectReport found =
        detect_with_certificate(load("pig.off"), certificate_of(bytes()), key(), asking(Method::Waves));
    EXPECT_FALSE(found.registration->found);
    EXPECT_EQ(*found.p_value, 1);
}

TEST(Certificate, ReadsNormsInTheOriginalsFrame)
{
    const Certificate certificate = make_certificate(fandisk(), key(), embedding(Method::LM));
    EXPECT_FALSE(certificate.waves);
    Surface suspect = fandisk();
    (void)embed(suspect, key(), embedding(Method::LM));
    attack(suspect, Attack::Crop, 0.3);
    attack(suspect, Attack::Similarity);
    EXPECT_LT(*detect_with_certificate(suspect, certificate, key(), asking(Method::LM)).p_value, 1e-6);
    EXPECT_THROW((void)detect_with_certificate(suspect, certificate, key(), asking(Method::Waves)), Error);
}

TEST(Certificate, RefusesWhatIsNone)
{
    EXPECT_NE(refusal_of(std::string()).find("no certificate"), std::string::npos);
    EXPECT_NE(refusal_of("ply\nformat ascii 1.0\n").find("no certificate"), std::string::npos);
    std::string later = bytes();
    later[later.find("1\n")] = '2';
    EXPECT_NE(refusal_of(later).find("version 2"), std::string::npos);
    for (const std::size_t length : {bytes().size() - 1, bytes().size() / 2, bytes().find('\n') + 3})
        EXPECT_NE(refusal_of(bytes().substr(0, length)).find("cut off"), std::string::npos) << length;
    std::string damaged = bytes();
    damaged[damaged.size() / 2] ^= 1;
    EXPECT_NE(refusal_of(damaged).find("damaged"), std::string::npos);
}

/// A certificate with these bytes somewhere in it, and the checksum that goes with them.
std::string forged(std::string file, std::size_t at, const std::string& bytes)
{
    file.replace(at, bytes.size(), bytes);
    std::uint64_t hash = 14695981039346656037U; // FNV-1a, as published
    for (std::size_t i = file.find('\n') + 1; i < file.size() - 8; ++i)
        hash = (hash ^ static_cast<unsigned char>(file[i])) * 1099511628211U;
    for (int i = 0; i < 8; ++i)
        file[file.size() - 8 + i] = static_cast<char>(hash >> 8 * i & 255U);
    return file;
}

TEST(Certificate, RefusesNumbersThatAreNone)
{
    const std::size_t content = bytes().find('\n') + 1;
    const std::size_t centre = content + 2 + 4;
    EXPECT_EQ(forged(bytes(), content, bytes().substr(content, 2)), bytes());
    const std::string not_a_number(8, '\xff');
    EXPECT_NE(refusal_of(forged(bytes(), centre, not_a_number)).find("not finite"), std::string::npos);
    // Waves and no shells: the byte that says so is the last but for the checksum; before it 64 values, 9 axes.
    const std::size_t values = bytes().size() - 8 - 1 - 64 * sizeof(float);
    EXPECT_NE(refusal_of(forged(bytes(), values, not_a_number)).find("not finite"), std::string::npos);
    EXPECT_NE(refusal_of(forged(bytes(), values - 8, not_a_number)).find("not finite"), std::string::npos);
    const std::size_t length = centre + 12 * sizeof(double); // of the solid's frame, behind its centre and axes
    EXPECT_NE(refusal_of(forged(bytes(), length, std::string(8, '\0'))).find("make no sense"), std::string::npos);
}

TEST(Certificate, RefusesAnotherKeyOrSettingAndMethodsThatNeedTheOriginal)
{
    EXPECT_NE(refusal_of(Key("another"), asking(Method::Waves)).find("another key"), std::string::npos);
    DetectOptions more = asking(Method::Waves);
    more.carriers.bits = 128;
    EXPECT_NE(refusal_of(key(), more).find("64 bits"), std::string::npos);
    EXPECT_NE(refusal_of(key(), asking(Method::Spectral)).find("needs the original itself"), std::string::npos);
    EXPECT_NE(refusal_of(key(), asking(Method::LM)).find("another method"), std::string::npos);
    EXPECT_THROW((void)make_certificate(fandisk(), key(), embedding(Method::Geodesic)), Error);
    EXPECT_THROW((void)make_certificate({}, key(), embedding(Method::Waves)), Error);
}
