// SPDX-License-Identifier: GPL-3.0-or-later
// Every kind of mesh that no one should hand in, through every function of the library: an error that says what to do
// and leaves the surface bit for bit as it was, or a right result.

#include "support/load.h"
#include "support/shapes.h"
#include "vcg_ext/attack/attack.h"
#include "vcg_ext/base/error.h"
#include "vcg_ext/carrier/statistic.h"
#include "vcg_ext/method/methods.h"
#include "vcg_ext/metric/distortion.h"
#include "vcg_ext/payload/code.h"
#include "vcg_ext/watermark/watermark.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>

using namespace vcg_ext;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A closed bumpy body with one longest axis, of some 2,600 vertices.
Surface body()
{
    Surface surface = shapes::sphere(4);
    for (Point& p : surface.points)
        p = p * (1 + 0.2 * std::sin(5 * p.x() + 1) * std::cos(4 * p.y()) + 0.1 * p.z());
    for (Point& p : surface.points)
        p = Point(2.0 * p.x(), 1.4 * p.y(), p.z());
    return surface;
}

template <class Change>
Surface changed(Change change)
{
    Surface surface = body();
    change(surface);
    return surface;
}

struct Input {
    const char* name;
    Surface (*make)();
};

Surface scaled(double scale)
{
    return changed([scale](Surface& s) {
        for (Point& p : s.points)
            p *= scale;
    });
}

const Input inputs[] = {
    {"Empty", [] { return Surface(); }},
    {"PointCloud",
     [] {
         return Surface{body().points, {}};
     }},
    {"OneFace",
     [] {
         return Surface{{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}, {{0, 1, 2}}};
     }},
    {"OnePlace",
     [] {
         return Surface{Points(50, Point(1, 2, 3)), {{0, 1, 2}, {3, 4, 5}, {7, 8, 9}}};
     }},
    {"OneLine",
     [] {
         return Surface{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 0, 0}}, {{0, 1, 2}, {1, 2, 3}}};
     }},
    {"Plane", [] { return shapes::triangular_grid(1, 1, 0.04); }},
    {"Sphere", [] { return shapes::sphere(4); }},
    {"FloatSphere",
     [] {
         Surface s = shapes::sphere(4);
         s.points = rounded_to_float(s.points);
         return s;
     }},
    {"OneNaN", [] { return changed([](Surface& s) { s.points[7].y() = nan_value; }); }},
    {"AllNaN",
     [] { return changed([](Surface& s) { s.points.assign(s.points.size(), Point::Constant(nan_value)); }); }},
    {"Infinite", [] { return changed([](Surface& s) { s.points[9].x() = -infinity; }); }},
    {"UnusedNaN", [] { return changed([](Surface& s) { s.points.emplace_back(nan_value, 0, 0); }); }},
    {"FaceOfNoVertex", [] { return changed([](Surface& s) { s.triangles[3][1] = 1000000; }); }},
    {"FaceBelowZero", [] { return changed([](Surface& s) { s.triangles[3][1] = -1; }); }},
    {"Scale1e30", [] { return scaled(1e30); }},
    {"Scale1e-30", [] { return scaled(1e-30); }},
    {"Scale1e300", [] { return scaled(1e300); }},
    {"Scale1e-300", [] { return scaled(1e-300); }},
    {"OneVertexFarOut", [] { return changed([](Surface& s) { s.points[11] *= 1e30; }); }},
    {"FarFromOrigin",
     [] {
         return changed([](Surface& s) {
             for (Point& p : s.points)
                 p = (p + Point(4e6, 0, 0)).cast<float>().cast<double>();
         });
     }},
    {"ZeroAreaFaces",
     [] {
         return changed([](Surface& s) {
             for (int f = 0; f < 200; ++f)
                 s.points[s.triangles[f][2]] = (s.points[s.triangles[f][0]] + s.points[s.triangles[f][1]]) / 2;
             s.triangles.push_back({1, 1, 2});
             s.triangles.push_back({5, 5, 5});
         });
     }},
    {"DoubledVertices",
     [] {
         return changed([](Surface& s) {
             const auto n = static_cast<int>(s.points.size());
             s.points.insert(s.points.end(), s.points.begin(), s.points.begin() + n / 2);
             for (std::size_t f = 0; f < s.triangles.size(); f += 3)
                 for (int& v : s.triangles[f])
                     v += v < n / 2 ? n : 0;
         });
     }},
    {"DoubledFaces",
     [] {
         return changed(
             [](Surface& s) { s.triangles.insert(s.triangles.end(), s.triangles.begin(), s.triangles.begin() + 99); });
     }},
    {"UnusedVertices",
     [] { return changed([](Surface& s) { s.points.insert(s.points.end(), 500, Point(9, 9, 9)); }); }},
    {"NonManifoldEdge",
     [] {
         return changed([](Surface& s) {
             const Triangle t = s.triangles[40];
             s.points.push_back(1.3 * s.points[t[0]]);
             s.triangles.push_back({t[0], t[1], static_cast<int>(s.points.size()) - 1});
         });
     }},
    {"NonManifoldVertex",
     [] {
         return changed([](Surface& s) {
             const auto n = static_cast<int>(s.points.size());
             const Surface other = s;
             for (const Point& p : other.points)
                 s.points.push_back(2 * s.points[0] - p);
             for (Triangle t : other.triangles) {
                 for (int& v : t)
                     v = v == 0 ? 0 : v + n; // both bodies meet in vertex 0
                 s.triangles.push_back({t[0], t[2], t[1]});
             }
         });
     }},
    {"Open", [] { return changed([](Surface& s) { s.triangles.resize(s.triangles.size() * 2 / 3); }); }},
    {"FewScatteredFaces",
     [] {
         return changed([](Surface& s) {
             std::vector<Triangle> some;
             for (std::size_t f = 0; f < s.triangles.size(); f += 40)
                 some.push_back(s.triangles[f]);
             s.triangles = some;
         });
     }},
    {"ThreeComponents",
     [] {
         return changed([](Surface& s) {
             const Surface one = s;
             const auto n = static_cast<int>(one.points.size());
             for (int copy = 1; copy < 3; ++copy) {
                 for (const Point& p : one.points)
                     s.points.push_back(0.5 * p + Point(0, 3.0 * copy, copy));
                 for (const Triangle& t : one.triangles)
                     s.triangles.push_back({t[0] + copy * n, t[1] + copy * n, t[2] + copy * n});
             }
         });
     }},
    {"InsideOut",
     [] {
         return changed([](Surface& s) {
             for (Triangle& t : s.triangles)
                 std::swap(t[0], t[1]);
         });
     }},
    {"MixedOrientation",
     [] {
         return changed([](Surface& s) {
             for (std::size_t f = 0; f < s.triangles.size(); f += 2)
                 std::swap(s.triangles[f][0], s.triangles[f][1]);
         });
     }},
    {"SelfIntersecting", [] { return changed([](Surface& s) { std::swap(s.points[3], s.points[900]); }); }},
    {"Spikes",
     [] {
         return changed([](Surface& s) {
             for (std::size_t v = 0; v < s.points.size(); v += 100)
                 s.points[v] *= 50;
         });
     }},
};

bool same_bytes(const Surface& a, const Surface& b)
{
    return a.triangles == b.triangles && a.points.size() == b.points.size() &&
           (a.points.empty() || std::memcmp(a.points.data(), b.points.data(), a.points.size() * sizeof(Point)) == 0);
}

bool finite(const Surface& surface)
{
    for (const Point& p : surface.points)
        if (!p.allFinite())
            return false;
    return true;
}

const Key& test_key()
{
    static const Key key("bad_input_test");
    return key;
}

/// An error says why and what to do, and that in more than one sentence or clause.
void expect_useful(const std::string& text)
{
    EXPECT_GT(text.size(), 30u) << text;
    EXPECT_EQ(text.back(), '.') << text;
    EXPECT_EQ(text.find("nan"), std::string::npos) << text;
    EXPECT_EQ(text.find("bad_input_test"), std::string::npos) << text;
}

class BadInput : public testing::TestWithParam<Input> {};

TEST_P(BadInput, EmbedAndDetectAnswerOrRefuse)
{
    const Surface cover = GetParam().make();
    for (const MethodRow& row : all_methods())
        for (const Statistic statistic : {Statistic::Mean, Statistic::Variance}) {
            if (!row.has_statistic && statistic == Statistic::Variance)
                continue;
            SCOPED_TRACE(std::string(row.name) + " " + name(statistic));
            EmbedOptions options;
            options.carriers.method = row.method;
            options.carriers.statistic = statistic;
            options.carriers.bits = 16;
            options.message = read_message("bits:1011010100011100");
            DetectOptions reading;
            reading.carriers = options.carriers;
            reading.expected = {options.message};
            const auto mark = [&](const EmbedOptions& wanted) {
                Surface stego = cover;
                try {
                    const EmbedReport report = embed(stego, test_key(), wanted);
                    EXPECT_TRUE(finite(stego));
                    EXPECT_EQ(report.detection_ratio, 1);
                    EXPECT_TRUE(std::isfinite(report.mrms) && std::isfinite(report.mrms_relative));
                    reading.carriers.bits = wanted.carriers.bits;
                    reading.expected = {wanted.message};
                    EXPECT_EQ(detect(stego, test_key(), reading).detection_ratio, 1);
                    return -1;
                } catch (const DoesNotFit& cause) {
                    EXPECT_TRUE(same_bytes(stego, cover));
                    const int carries = carriers_that_fit(stego, test_key(), wanted, cause);
                    EXPECT_TRUE(carries < wanted.carriers.bits || carries == recommended_numbers().front()) << carries;
                    return carries;
                } catch (const Error& error) {
                    expect_useful(error.what());
                    EXPECT_TRUE(same_bytes(stego, cover));
                    return 0;
                }
            };
            try {
                const DetectReport unmarked = detect(cover, test_key(), reading);
                EXPECT_FALSE(*unmarked.present);
                EXPECT_EQ(unmarked.bits.size(), 16u);
                for (const double soft : unmarked.soft)
                    EXPECT_TRUE(std::isfinite(soft));
            } catch (const Error& error) {
                expect_useful(error.what());
            }
            const int carries = mark(options);
            if (carries > 0) {
                options.carriers.bits = carries;
                options.message.bits.resize(carries);
                EXPECT_EQ(mark(options), -1) << "refuses the number that it named, " << carries;
            }
        }
}

TEST_P(BadInput, AttacksAnswerOrRefuse)
{
    const Surface before = GetParam().make();
    for (const Attack attack : all_attacks()) {
        SCOPED_TRACE(name(attack));
        Surface surface = before;
        AttackOptions options;
        options.attack = attack;
        if (attack == Attack::Isosurface)
            options.amount = 0.05;
        try {
            const AttackReport report = apply_attack(surface, options);
            EXPECT_TRUE(finite(surface));
            EXPECT_EQ(report.faces, static_cast<int>(surface.triangles.size()));
            EXPECT_GT(report.faces, 0);
        } catch (const Error& error) {
            expect_useful(error.what());
            EXPECT_TRUE(same_bytes(surface, before));
        }
    }
}

TEST_P(BadInput, MeasuringAnswersOrRefuses)
{
    const Surface surface = GetParam().make();
    const Surface good = body();
    for (const auto& [reference, measured] : {std::pair(&good, &surface), {&surface, &good}, {&surface, &surface}})
        try {
            DistortionOptions options;
            options.samples = 500;
            const DistortionReport report = measure(*reference, *measured, options);
            for (const double value :
                 {report.mrms, report.hausdorff, report.mean, report.mrms_relative, report.snr_db.value_or(0),
                  report.msdm.value_or(0), report.volume_change.value_or(0), report.area_change})
                EXPECT_TRUE(std::isfinite(value));
            EXPECT_GE(report.hausdorff, report.mrms * (1 - 1e-6));
            if (reference == measured) {
                EXPECT_LE(report.hausdorff_relative, 1e-6);
            }
        } catch (const Error& error) {
            expect_useful(error.what());
        }
}

INSTANTIATE_TEST_SUITE_P(Library, BadInput, testing::ValuesIn(inputs), [](const auto& info) {
    std::string text = info.param.name;
    for (char& c : text)
        c = c == '-' ? 'm' : c;
    return text;
});

} // namespace
