// SPDX-License-Identifier: GPL-3.0-or-later
// Geodesic watermarks beside chapter 4 of the thesis: Tables 4.2, 4.3 and 4.5, Figures 4.10 to 4.14, 4.18 and 4.19.
// Usage: geodesic_tables [bits|distortion|attacks]...; all without an argument.

#include "support/load.h"
#include "support/shapes.h"
#include "vcg_ext/attack/attack.h"
#include "vcg_ext/base/error.h"
#include "vcg_ext/base/weld.h"
#include "vcg_ext/carrier/statistic.h"
#include "vcg_ext/carrier/strips.h"
#include "vcg_ext/geometry/normals.h"
#include "vcg_ext/key/stream.h"
#include "vcg_ext/metric/distortion.h"
#include "vcg_ext/watermark/watermark.h"

#include <cstdio>
#include <cstring>
#include <map>

using namespace vcg_ext;

namespace {

constexpr int keys = 5;
constexpr Statistic statistics_of_chapter_4[] = {Statistic::Mean, Statistic::Variance};
constexpr FrontScheme schemes[] = {FrontScheme::PredictCorrect, FrontScheme::Sequential};

const Key& key_number(int i)
{
    static std::map<int, Key> made;
    const auto at = made.find(i);
    return at != made.end() ? at->second : made.emplace(i, Key("geodesic " + std::to_string(i))).first->second;
}

const char* text(FrontScheme scheme)
{
    return scheme == FrontScheme::PredictCorrect ? "ours" : "thesis' VPS";
}

const char* pro(Statistic statistic)
{
    return statistic == Statistic::Mean ? "ProMean" : "ProVar";
}

EmbedOptions options_for(Method method, Statistic statistic, int bits, int key)
{
    EmbedOptions options;
    options.carriers.method = method;
    options.carriers.statistic = statistic;
    options.carriers.bits = bits;
    options.carriers.trim = 0.1;
    Stream draws = key_number(key).stream("message");
    for (int i = 0; i < bits; ++i)
        options.message.bits.push_back(static_cast<std::uint8_t>(draws.below(2)));
    return options;
}

DetectReport read(const Surface& surface, const EmbedOptions& embedded, int key)
{
    DetectOptions options;
    options.carriers = embedded.carriers;
    options.expected = {embedded.message};
    return detect(surface, key_number(key), options);
}

double largest_turn(const Surface& before, const Surface& after)
{
    const Points old_normals = face_normals(before.points, before.triangles);
    const Points new_normals = face_normals(after.points, after.triangles);
    double least = 1;
    for (std::size_t f = 0; f < old_normals.size(); ++f)
        if (!old_normals[f].isZero())
            least = std::min(least, old_normals[f].dot(new_normals[f]));
    return std::acos(least) * 180 / std::acos(-1.0);
}

/// Tables 4.3 and 4.5.
void bits_and_moves()
{
    std::printf(
        "detection without attack | after rotation, scale and renumbering | share of moved vertices that took 1 / 2 "
        "/ 3 / 4-50 moves / ended short, %% (worst key) | rounds | largest turn of a face\n");
    for (const char* mesh : {"bunny00.off", "fandisk.off", "armadillo.off", "refined_elephant.off"}) {
        const Surface cover = load(mesh);
        for (const int bits : {32, 64, 128, 256})
            for (const Statistic statistic : statistics_of_chapter_4)
                for (const FrontScheme scheme : schemes) {
                    double ratio = 0;
                    double moved_ratio = 0;
                    double turn = 0;
                    double worst_short = 0;
                    std::array<double, 5> share{};
                    int rounds = 0;
                    int done = 0;
                    std::string refused;
                    for (int key = 0; key < keys; ++key) {
                        EmbedOptions options = options_for(Method::Geodesic, statistic, bits, key);
                        options.placement.front_scheme = scheme;
                        Surface stego = cover;
                        try {
                            const EmbedReport report = embed(stego, key_number(key), options);
                            const double total = report.moves->total() / 100.0;
                            for (int i = 0; i < 4; ++i)
                                share[i] += report.moves->moves[i] / total;
                            share[4] += report.moves->unconverged / total;
                            worst_short = std::max(worst_short, report.moves->unconverged / total);
                            rounds = std::max(rounds, report.rounds);
                        } catch (const Error& error) {
                            refused = error.what();
                            continue;
                        }
                        ++done;
                        ratio += *read(stego, options, key).detection_ratio;
                        turn = std::max(turn, largest_turn(cover, stego));
                        Surface moved = shapes::renumbered(shapes::moved(stego, 3.7, 1, {1, 2, 3}, {1, -2, 3}), 7);
                        moved.points = rounded_to_float(moved.points);
                        moved_ratio += *read(moved, options, key).detection_ratio;
                    }
                    if (done > 0)
                        std::printf(
                            "%-20s %3d %-7s %-11s %.3f | %.3f | %5.2f %5.2f %5.2f %5.2f %6.3f (%.3f) | %d | %.0f\n",
                            mesh, bits, pro(statistic), text(scheme), ratio / done, moved_ratio / done, share[0] / done,
                            share[1] / done, share[2] / done, share[3] / done, share[4] / done, worst_short, rounds,
                            turn);
                    if (!refused.empty())
                        std::printf("%-20s %3d %-7s %-11s refused for %d of %d keys: %s\n", mesh, bits, pro(statistic),
                                    text(scheme), keys - done, keys, refused.c_str());
                    std::fflush(stdout);
                }
    }
}

/// Table 4.2, MRMS by Metro's measure, 64 bits.
void distortion()
{
    std::printf("MRMS over the diagonal x 1e-4 (over Cho's) | MSDM\n");
    for (const char* mesh : {"bunny00.off", "fandisk.off", "armadillo.off", "refined_elephant.off"}) {
        const Surface cover = load(mesh);
        for (const Statistic statistic : statistics_of_chapter_4) {
            std::map<std::string, double> mrms;
            std::map<std::string, double> msdm;
            const auto add = [&](const std::string& what, const EmbedOptions& options, int key) {
                Surface stego = cover;
                embed(stego, key_number(key), options);
                const DistortionReport report = measure(cover, stego);
                mrms[what] += report.mrms_relative * 1e4 / keys;
                msdm[what] += report.msdm.value_or(0) / keys;
            };
            for (int key = 0; key < keys; ++key) {
                add("Cho", options_for(Method::Cho, statistic, 64, key), key);
                add("L-M", options_for(Method::LM, statistic, 64, key), key);
                for (const FrontScheme scheme : schemes) {
                    EmbedOptions options = options_for(Method::Geodesic, statistic, 64, key);
                    options.placement.front_scheme = scheme;
                    add(text(scheme), options, key);
                }
            }
            std::printf("%-20s %-7s", mesh, pro(statistic));
            for (const char* what : {"Cho", "L-M", "thesis' VPS", "ours"})
                std::printf("   %s %.3f (%.3f) msdm %.3f", what, mrms[what], mrms[what] / mrms["Cho"], msdm[what]);
            std::printf("\n");
            std::fflush(stdout);
        }
    }
}

/// Figures 4.10 to 4.14, and how far the source moves (4.18, 4.19), in strips.
void attacks()
{
    struct Case {
        Attack attack;
        double amount;
        int iterations;
    };
    const Case cases[] = {{Attack::Noise, 0.001, -1},   {Attack::Noise, 0.003, -1},  {Attack::Noise, 0.005, -1},
                          {Attack::Smooth, 0.3, 5},     {Attack::Smooth, 0.3, 10},   {Attack::Smooth, 0.5, 5},
                          {Attack::Simplify, 0.3, -1},  {Attack::Simplify, 0.5, -1}, {Attack::Simplify, 0.7, -1},
                          {Attack::Simplify, 0.9, -1},  {Attack::Quantize, 10, -1},  {Attack::Quantize, 9, -1},
                          {Attack::Quantize, 8, -1},    {Attack::Quantize, 7, -1},   {Attack::Resample, 1, -1},
                          {Attack::Resample, 0.6, -1},  {Attack::Subdivide, -1, -1}, {Attack::Similarity, -1, -1},
                          {Attack::Affine, -1, -1},     {Attack::Reorder, -1, -1},   {Attack::Remesh, -1, -1},
                          {Attack::Isosurface, -1, -1}, {Attack::Crop, -1, -1}};
    std::printf("detection ratio, 64 bits, %d keys: ProMean ProVar ChoMean ChoVar | median shift of the source in "
                "strips | rounds "
                "of smoothing\n",
                keys);
    for (const char* mesh : {"bunny00.off", "fandisk.off", "armadillo.off", "refined_elephant.off"}) {
        const Surface cover = load(mesh);
        std::map<std::pair<Method, Statistic>, std::vector<Surface>> marked;
        for (const Method method : {Method::Geodesic, Method::Cho})
            for (const Statistic statistic : statistics_of_chapter_4)
                for (int key = 0; key < keys; ++key) {
                    Surface stego = cover;
                    embed(stego, key_number(key), options_for(method, statistic, 64, key));
                    marked[{method, statistic}].push_back(std::move(stego));
                }
        for (const Case& c : cases) {
            std::printf("%-20s %-10s %6g x%2d ", mesh, name(c.attack), c.amount, c.iterations);
            std::vector<double> shifts;
            std::map<int, int> smoothing;
            for (const Method method : {Method::Geodesic, Method::Cho})
                for (const Statistic statistic : statistics_of_chapter_4) {
                    double ratio = 0;
                    int done = 0;
                    for (int key = 0; key < keys; ++key) {
                        const Surface& stego = marked[{method, statistic}][key];
                        Surface attacked = stego;
                        try {
                            apply_attack(attacked, {c.attack, c.amount, c.iterations, static_cast<std::uint64_t>(key)});
                        } catch (const Error&) {
                            continue;
                        }
                        const DetectReport found = read(attacked, options_for(method, statistic, 64, key), key);
                        ratio += *found.detection_ratio;
                        ++done;
                        if (method != Method::Geodesic)
                            continue;
                        ++smoothing[*found.smoothing_rounds];
                        if (c.attack == Attack::Similarity || c.attack == Attack::Affine || c.attack == Attack::Crop)
                            continue; // no common coordinates to compare in
                        const Welded before = weld(stego);
                        const Welded after = weld(attacked);
                        const auto& [points, triangles] = before.surface;
                        const int sites = static_cast<int>(points.size());
                        const Fans fans = fans_of(vertex_faces(sites, triangles), triangles);
                        const Points directions = source_directions(key_number(key).stream("direction"));
                        const StripFrame frame =
                            strip_frame(before.surface, principal_frame(before.surface), directions);
                        const Strips strips =
                            strips_from(frame, distances_from(frame.source, points, triangles, fans), sites, 0.1, 64);
                        shifts.push_back(
                            (strip_frame(after.surface, principal_frame(after.surface), directions).source.position -
                             frame.source.position)
                                .norm() /
                            strips.carriers.width);
                    }
                    std::printf(" %.3f", done > 0 ? ratio / done : std::nan(""));
                }
            std::sort(shifts.begin(), shifts.end());
            if (shifts.empty())
                std::printf(" |     -");
            else
                std::printf(" | %5.2f (%.2f)", shifts[shifts.size() / 2], shifts.back());
            std::printf(" | %d %d %d\n", smoothing[0], smoothing[1], smoothing[3]);
            std::fflush(stdout);
        }
    }
}

} // namespace

int main(int count, char** arguments)
{
    const auto wanted = [&](const char* what) {
        for (int i = 1; i < count; ++i)
            if (std::strcmp(arguments[i], what) == 0)
                return true;
        return count == 1;
    };
    if (wanted("bits"))
        bits_and_moves();
    if (wanted("distortion"))
        distortion();
    if (wanted("attacks"))
        attacks();
}
