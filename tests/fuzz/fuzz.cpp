// SPDX-License-Identifier: GPL-3.0-or-later
// Random meshes, broken in random ways, through random calls of the library; under the sanitizers (-DSANITIZE=
// address,undefined), which end the program at the first fault. An Error is a good answer; then, and only then, the
// surface must be as it was. Each case is made from one number, which is printed where something is wrong.
// Usage: fuzz SECONDS [FIRST]     from case FIRST on, 0 without
//        fuzz --cases COUNT       so many from case 0 on: the same on every machine
//        fuzz --case NUMBER       that case alone
//        fuzz --fault address     reads beyond an array, or casts without meaning, in case 7: its number must be told
//        fuzz --fault undefined

#include "support/shapes.h"
#include "vcg_ext/attack/attack.h"
#include "vcg_ext/base/error.h"
#include "vcg_ext/carrier/statistic.h"
#include "vcg_ext/key/random.h"
#include "vcg_ext/key/stream.h"
#include "vcg_ext/method/methods.h"
#include "vcg_ext/metric/distortion.h"
#include "vcg_ext/watermark/watermark.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <unistd.h>

using namespace vcg_ext;

namespace {

constexpr unsigned seconds_per_case = 120;

int pick(Stream& draws, int count)
{
    return static_cast<int>(draws.below(static_cast<std::uint64_t>(count)));
}

Surface start(Stream& draws)
{
    switch (pick(draws, 5)) {
    case 0:
        return shapes::box(1, 2, 3);
    case 1:
        return shapes::triangular_grid(1, 1, 0.1);
    case 2: { // anything
        Surface s;
        const int vertices = 1 + pick(draws, 40);
        for (int v = 0; v < vertices; ++v)
            s.points.emplace_back(pick(draws, 4), pick(draws, 4), uniform(draws));
        for (int f = pick(draws, 80); f > 0; --f)
            s.triangles.push_back({pick(draws, vertices), pick(draws, vertices), pick(draws, vertices)});
        return s;
    }
    default: {
        Surface s = shapes::sphere(1 + pick(draws, 3));
        for (Point& p : s.points)
            p = (p * (1 + 0.3 * std::sin(5 * p.x() + 3 * p.y()))).cwiseProduct(Point(2, 1.5, 1));
        return s;
    }
    }
}

void damage(Surface& s, Stream& draws)
{
    constexpr double odd[] = {0,     -0.0, 1e-310, 1e-30,
                              1e30,  1e38, 1e300,  std::numeric_limits<double>::quiet_NaN(),
                              -1e19, 1e-9, 1,      std::numeric_limits<double>::infinity()};
    const auto vertex = [&] { return pick(draws, static_cast<int>(s.points.size())); };
    const auto face = [&] { return pick(draws, static_cast<int>(s.triangles.size())); };
    if (s.points.empty() || s.triangles.empty())
        return;
    switch (pick(draws, 12)) {
    case 0:
        s.points[vertex()][pick(draws, 3)] = odd[pick(draws, std::size(odd))];
        break;
    case 1:
        s.points[vertex()] = s.points[vertex()];
        break;
    case 2:
        s.triangles[face()][pick(draws, 3)] = vertex();
        break;
    case 3:
        std::swap(s.triangles[face()][0], s.triangles[face()][1]);
        break;
    case 4:
        s.triangles.push_back(s.triangles[face()]);
        break;
    case 5:
        s.triangles.resize(std::size_t{1} + face());
        break;
    case 6:
        s.points.push_back(s.points[vertex()]);
        break;
    case 7: {
        const double scale = std::pow(10, pick(draws, 60) - 30);
        for (Point& p : s.points)
            p *= scale;
        break;
    }
    case 8: {
        const Point shift = Point::Constant(std::pow(10, pick(draws, 12)));
        for (Point& p : s.points)
            p = (p + shift).cast<float>().cast<double>();
        break;
    }
    case 9: {
        const int axis = pick(draws, 3);
        for (Point& p : s.points)
            p[axis] = 0;
        break;
    }
    case 10: {
        const Surface copy = s;
        const auto n = static_cast<int>(s.points.size());
        s.points.insert(s.points.end(), copy.points.begin(), copy.points.end());
        for (const Triangle& t : copy.triangles)
            s.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
        break;
    }
    default:
        for (std::size_t v = 0; v < s.points.size(); v += 3)
            s.points[v] *= 1 + uniform(draws);
    }
}

bool same(const Surface& a, const Surface& b)
{
    return a.triangles == b.triangles && a.points.size() == b.points.size() &&
           (a.points.empty() || std::memcmp(a.points.data(), b.points.data(), a.points.size() * sizeof(Point)) == 0);
}

void demand(bool holds, const char* what)
{
    if (!holds) {
        std::printf("%s\n", what);
        std::fflush(stdout);
        std::abort();
    }
}

void embed_and_detect(const Surface& before, const Key& key, Stream& draws)
{
    EmbedOptions options;
    options.carriers.method = all_methods()[pick(draws, all_methods().size())].method;
    options.carriers.statistic = static_cast<Statistic>(pick(draws, 2));
    constexpr int counts[] = {1, 2, 8, 16, 64, 1024, 0, -1};
    options.carriers.bits = counts[pick(draws, std::size(counts))];
    constexpr double trims[] = {-1, -1, 0, 0.1, 0.45, 0.5, -2, std::numeric_limits<double>::quiet_NaN()};
    options.carriers.trim = trims[pick(draws, std::size(trims))];
    constexpr double strengths[] = {0, 0, 0.1, 0.3, 10, -1, 1e300, std::numeric_limits<double>::infinity()};
    options.placement.strength = strengths[pick(draws, std::size(strengths))];
    options.placement.storage = static_cast<Storage>(pick(draws, 2));
    options.placement.max_rounds = 3;
    options.message = read_message("bits:10110010");
    DetectOptions reading;
    reading.carriers = options.carriers;
    reading.carriers.quick = options.carriers.bits != 2; // a full reading, or a search for Bits, takes its time
    if (options.carriers.bits == 0)
        reading.carriers.bits = 64;
    reading.expected = {options.message};
    Surface after = before;
    try {
        const EmbedReport report = embed(after, key, options);
        reading.carriers.bits = report.carriers;
        demand(detect(after, key, reading).detection_ratio == 1.0, "marked, but not read back");
    } catch (const Error&) {
        demand(same(before, after), "an error changed the mesh");
    }
    try {
        const DetectReport found = detect(before, key, reading);
        demand(std::all_of(found.soft.begin(), found.soft.end(), [](double x) { return std::isfinite(x); }),
               "soft values that are not finite");
    } catch (const Error&) {
    }
}

void attack(const Surface& before, Stream& draws)
{
    AttackOptions options;
    options.attack = all_attacks()[pick(draws, static_cast<int>(all_attacks().size()))];
    constexpr double amounts[] = {-1, -1, -1, 0, 0.05, 0.5, 0.9, 2, 16, 1e9};
    options.amount = options.attack == Attack::Isosurface ? 0.1 : amounts[pick(draws, std::size(amounts))];
    options.iterations = pick(draws, 4) - 1;
    Surface after = before;
    try {
        apply_attack(after, options);
        demand(std::all_of(after.points.begin(), after.points.end(), [](const Point& p) { return p.allFinite(); }),
               "an attack left coordinates that are not finite");
    } catch (const Error&) {
        demand(same(before, after), "an error changed the mesh");
    }
}

void compare(const Surface& one, const Surface& other)
{
    DistortionOptions options;
    options.samples = 200;
    try {
        demand(std::isfinite(measure(one, other, options).mrms), "a distance that is not finite");
    } catch (const Error&) {
    }
}

void run(std::uint64_t number, const Key& key)
{
    Stream draws = seeded_stream(number, "fuzz");
    Surface surface = start(draws);
    const Surface whole = surface;
    for (int i = pick(draws, 5); i > 0; --i)
        damage(surface, draws);
    switch (pick(draws, 4)) {
    case 0:
        attack(surface, draws);
        break;
    case 1:
        compare(whole, surface);
        break;
    default:
        embed_and_detect(surface, key, draws);
    }
}

volatile std::uint64_t current = 0; // for the handler

void tell_case(int signal)
{
    char line[64];
    const int length = std::snprintf(line, sizeof line, "case %llu: %s\n", static_cast<unsigned long long>(current),
                                     signal == SIGALRM ? "hangs" : "fails");
    [[maybe_unused]] const auto told = write(STDOUT_FILENO, line, static_cast<std::size_t>(length));
    _exit(1);
}

/// Asks for the case's number where one hangs or dies. The sanitizers have a handler of their own for what else ends a
/// process, and abort after their report (tests/sanitize.sh asks for it).
void tell_where_it_dies()
{
    std::signal(SIGALRM, tell_case);
    std::signal(SIGABRT, tell_case);
#ifndef __SANITIZE_ADDRESS__
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL})
        std::signal(signal, tell_case);
#endif
}

/// What only a sanitizer sees.
int fault(const std::string& kind)
{
    current = 7;
    const std::vector<int> few(kind.size());
    volatile double huge = 1e300;
    return kind == "address" ? few.data()[few.size() + current - 7] : static_cast<int>(huge);
}

} // namespace

int main(int count, char** arguments)
{
    if (count < 2)
        return std::fprintf(stderr, "usage: fuzz SECONDS [FIRST], --cases COUNT, --case NUMBER, or --fault KIND\n"), 2;
    tell_where_it_dies();
    if (std::string(arguments[1]) == "--fault")
        return fault(count > 2 ? arguments[2] : "address");
    const Key key("fuzz");
    const bool counted = std::string(arguments[1]) == "--cases" && count > 2;
    const bool one = std::string(arguments[1]) == "--case" && count > 2;
    const std::uint64_t number = count > 2 ? std::strtoull(arguments[2], nullptr, 10) : 0;
    const std::uint64_t first = counted ? 0 : number;
    const std::uint64_t last = counted ? number : one ? first + 1 : UINT64_MAX;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(std::atoi(arguments[1]));
    const auto goes_on = [&] { return current < last && (counted || std::chrono::steady_clock::now() < end); };
    current = first;
    do {
        alarm(seconds_per_case);
        run(current, key);
        current = current + 1;
    } while (goes_on());
    std::printf("%llu cases, nothing wrong\n", static_cast<unsigned long long>(current - first));
}
