// SPDX-License-Identifier: GPL-3.0-or-later
// What is left of Waves after each attack: log10 p with the message known, and with the key alone.
// Usage: wave_tables [--strength 1e-4] [--waves 64] [--keys 1] [--row TEXT] [--ways] [mesh.off ...]
// --row TEXT: only attacks whose label contains it. --ways: also where the best way lies (view, t, u).

#include "support/load.h"
#include "vcg_ext/attack/attack.h"
#include "vcg_ext/base/parallel.h"
#include "vcg_ext/base/weld.h"
#include "vcg_ext/method/wave_embedding.h"
#include "vcg_ext/metric/distortion.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

using namespace vcg_ext;

namespace {

struct Row {
    const char* label;
    AttackOptions attack;
    bool mirror = false;
};

const std::vector<Row>& rows()
{
    static const std::vector<Row> all = {
        {"none", {Attack::Reorder}},
        {"similarity", {Attack::Similarity}},
        {"mirrored", {}, true},
        {"noise .1 %", {Attack::Noise, 0.001}},
        {"noise .3 %", {Attack::Noise, 0.003}},
        {"noise .5 %", {Attack::Noise, 0.005}},
        {"quantization 9", {Attack::Quantize, 9}},
        {"quantization 8", {Attack::Quantize, 8}},
        {"quantization 7", {Attack::Quantize, 7}},
        {"simplification 50 %", {Attack::Simplify, 0.5}},
        {"simplification 75 %", {Attack::Simplify, 0.75}},
        {"simplification 90 %", {Attack::Simplify, 0.9}},
        {"subdivision", {Attack::Subdivide}},
        {"remeshing x1", {Attack::Remesh, 1, 3}},
        {"remeshing x2", {Attack::Remesh, 2, 3}},
        {"resampling 50 %", {Attack::Resample, 0.5}},
        {"isosurface .5 %", {Attack::Isosurface, 0.005}},
        {"isosurface 1 %", {Attack::Isosurface, 0.01}},
        {"smoothing .5 x 5", {Attack::Smooth, 0.5, 5}},
        {"smoothing .5 x 10", {Attack::Smooth, 0.5, 10}},
    };
    return all;
}

double seconds()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Points as_float(const Points& points)
{
    Points result(points.size());
    for_each_index(static_cast<int>(points.size()), [&](int v) { result[v] = points[v].cast<float>().cast<double>(); });
    return result;
}

struct Reading {
    double known = 0;
    double alone = 0;
    WaveMatch match;
    double seconds = 0;
};

Reading read(const Surface& surface, const WavePlan& plan, const Bits& coded, const WaveReadOptions& options)
{
    const double start = seconds();
    Reading result;
    const WaveReading reading = read_waves(wave_body(weld(surface).surface), plan, options);
    const WavePresence presence = wave_presence(reading);
    result.match = wave_match(reading, presence, coded);
    result.known = result.match.log_p / std::log(10.0);
    result.alone = presence.log_p / std::log(10.0);
    result.seconds = seconds() - start;
    return result;
}

} // namespace

int main(int argc, char** argv)
{
    double strength = 1e-4;
    int waves = 64;
    int keys = 1;
    const char* only = "";
    bool ways = false;
    std::vector<std::string> meshes;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--strength" && i + 1 < argc)
            strength = std::atof(argv[++i]);
        else if (word == "--waves" && i + 1 < argc)
            waves = std::atoi(argv[++i]);
        else if (word == "--keys" && i + 1 < argc)
            keys = std::atoi(argv[++i]);
        else if (word == "--row" && i + 1 < argc)
            only = argv[++i];
        else if (word == "--ways")
            ways = true;
        else
            meshes.push_back(word);
    }
    if (meshes.empty())
        meshes = {"bunny00.off", "armadillo.off", "refined_elephant.off", "fandisk.off"};

    for (const std::string& name : meshes) {
        const Surface cover = weld(load(name)).surface;
        for (int number = 1; number <= keys; ++number) {
            const Key key("wave tables " + std::to_string(number));
            const WavePlan plan = wave_plan(key, waves);
            Stream draws = key.stream("message");
            Bits coded;
            for (int k = 0; k < waves; ++k)
                coded.push_back(static_cast<std::uint8_t>(draws.below(2)));
            WaveReadOptions options;
            options.strength = strength;
            const Reading before = read(cover, plan, coded, options);
            Surface stego = cover;
            try {
                const Cover held(cover);
                const double start = seconds();
                const WaveEmbedding mark = embed_waves(held, plan, coded, strength, as_float);
                const double took = seconds() - start;
                stego.points = mark.points;
                DistortionOptions sampling;
                sampling.samples = 100000;
                const DistortionReport change = measure(cover, stego, sampling);
                std::printf(
                    "%s %zu vertices, key %d, strength %g: MRMS %.2e, MSDM %.3f, D %.2e, rounds %d, worst %.4f D, "
                    "guarded %d, %.2f s; unmarked %.1f | %.1f, %.2f s\n",
                    name.c_str(), cover.points.size(), number, strength, change.mrms_relative, change.msdm.value_or(-1),
                    mark.step, mark.rounds, mark.worst, mark.guarded, took, before.known, before.alone, before.seconds);
            } catch (const Error& error) {
                std::printf("%s %zu vertices, key %d: %s\n", name.c_str(), cover.points.size(), number, error.what());
                continue;
            }
            for (const Row& row : rows()) {
                if (!std::strstr(row.label, only))
                    continue;
                Surface attacked = stego;
                try {
                    if (row.mirror) {
                        for (Point& p : attacked.points)
                            p[2] = -p[2];
                        for (Triangle& t : attacked.triangles)
                            std::swap(t[1], t[2]);
                    } else {
                        AttackOptions attack = row.attack;
                        attack.seed = 3;
                        apply_attack(attacked, attack);
                    }
                    attacked.points = as_float(attacked.points);
                    const Reading after = read(attacked, plan, coded, options);
                    std::printf("  %-20s %7.1f | %6.1f %s", row.label, after.known, after.alone,
                                after.known > -6 ? "lost" : "    ");
                    if (ways)
                        std::printf("  view %d undone %d t %.1f u %.1f sum %.1f, %.2f s", after.match.way.view,
                                    after.match.way.undone, after.match.way.t, after.match.way.u, after.match.sum,
                                    after.seconds);
                    std::printf("\n");
                } catch (const Error& error) {
                    std::printf("  %-20s %s\n", row.label, error.what());
                }
                std::fflush(stdout);
            }
        }
    }
}
