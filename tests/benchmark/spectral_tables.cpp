// SPDX-License-Identifier: GPL-3.0-or-later
// Spectral watermarks beside the vertex-norm methods and the thesis' chapter 3.
// `spectral_tables readback | distortion | attacks | scale | all [keys]`

#include "support/load.h"
#include "vcg_ext/attack/attack.h"
#include "vcg_ext/base/error.h"
#include "vcg_ext/carrier/statistic.h"
#include "vcg_ext/watermark/watermark.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <sys/resource.h>

using namespace vcg_ext;

namespace {

Key key_number(int k)
{
    return Key("spectral " + std::to_string(k));
}

EmbedOptions options_of(Method method, Statistic statistic, double strength)
{
    EmbedOptions options;
    options.carriers.method = method;
    options.carriers.statistic = statistic;
    options.carriers.bits = 64;
    options.message = read_message("hex:0123456789abcdef");
    options.message.kind = Kind::Bits; // not coded, as in the thesis
    options.placement.strength = strength;
    options.carriers.trim = 0.1; // as in the thesis' tables
    return options;
}

double ratio_after(const Surface& surface, const Key& key, const EmbedOptions& embedded)
{
    DetectOptions options;
    options.carriers = embedded.carriers;
    options.expected = {embedded.message};
    return *detect(surface, key, options).detection_ratio;
}

Surface attacked(Surface surface, Attack attack, double amount, int iterations, int seed)
{
    AttackOptions options;
    options.attack = attack;
    options.amount = amount;
    options.iterations = iterations;
    options.seed = static_cast<std::uint64_t>(seed);
    (void)apply_attack(surface, options);
    return surface;
}

int faces_turned(const Surface& cover, const Surface& marked)
{
    int count = 0;
    for (const Triangle& t : cover.triangles)
        count += scaled_normal(cover.points, t).dot(scaled_normal(marked.points, t)) < 0;
    return count;
}

void readback(int keys)
{
    std::printf("mesh, keys, read blind, after similarity and renumbering, faces turned over, most rounds\n");
    for (const char* mesh : {"bunny00.off", "armadillo.off", "refined_elephant.off"}) {
        const Surface cover = load(mesh);
        int read = 0, moved = 0, turned = 0, rounds = 0;
        for (int k = 0; k < keys; ++k) {
            const Key key = key_number(k);
            EmbedOptions options = options_of(Method::Spectral, Statistic::Mean, 0);
            options.carriers.trim = -1;
            Surface marked = cover;
            const EmbedReport report = embed(marked, key, options);
            DetectOptions blind;
            blind.carriers = options.carriers;
            read += detect(marked, key, blind).bits == report.bits;
            turned += faces_turned(cover, marked);
            rounds = std::max(rounds, report.rounds);
            const Surface other = attacked(attacked(marked, Attack::Similarity, -1, -1, k), Attack::Reorder, -1, -1, k);
            moved += detect(other, key, blind).bits == report.bits;
        }
        std::printf("%-22s %d  %d  %d  %d  %d\n", mesh, keys, read, moved, turned, rounds);
        std::fflush(stdout);
    }
}

void distortion(int keys)
{
    std::printf("MRMS over ChoMean's at alpha .05 (thesis: .51 .64 .57 .40): K 15, K 8, as printed; ChoMean's over the "
                "diagonal\n");
    for (const char* mesh : {"bunny00.off", "armadillo.off", "refined_elephant.off", "diplodocus.off", "man.off",
                             "fandisk.off", "ChineseDragon-10kv.off"}) {
        const Surface cover = load(mesh);
        double sum[4] = {0, 0, 0, 0};
        for (int k = 0; k < keys; ++k) {
            EmbedOptions ways[4] = {
                options_of(Method::Spectral, Statistic::Mean, 15), options_of(Method::Spectral, Statistic::Mean, 8),
                options_of(Method::Spectral, Statistic::Mean, 15), options_of(Method::Cho, Statistic::Mean, 0.05)};
            ways[2].carriers.as_printed = true;
            for (int i = 0; i < 4; ++i) {
                if (i == 2 && k > 0)
                    continue; // exact eigenbases take long
                try {
                    Surface marked = cover;
                    sum[i] += embed(marked, key_number(k), ways[i]).mrms_relative * (i == 2 ? keys : 1);
                } catch (const Error&) {
                    sum[i] = std::numeric_limits<double>::quiet_NaN();
                }
            }
        }
        std::printf("%-22s %.2f  %.2f  %.2f  %.2e\n", mesh, sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3],
                    sum[3] / keys);
        std::fflush(stdout);
    }
}

void attacks(int keys)
{
    struct Column {
        const char* title;
        Attack attack;
        double amount;
        int iterations;
    };
    const Column columns[] = {{"noise .1", Attack::Noise, 0.001, -1},
                              {".3", Attack::Noise, 0.003, -1},
                              {".5", Attack::Noise, 0.005, -1},
                              {"smooth .5x5", Attack::Smooth, 0.5, 5},
                              {".5x10", Attack::Smooth, 0.5, 10},
                              {".2x10", Attack::Smooth, 0.2, 10},
                              {"quantize 9", Attack::Quantize, 9, -1},
                              {"8", Attack::Quantize, 8, -1},
                              {"7", Attack::Quantize, 7, -1},
                              {"simplify .3", Attack::Simplify, 0.3, -1},
                              {".5", Attack::Simplify, 0.5, -1},
                              {".7", Attack::Simplify, 0.7, -1},
                              {"resample .6", Attack::Resample, 0.6, -1},
                              {"remesh", Attack::Remesh, -1, -1},
                              {"subdivide", Attack::Subdivide, -1, 1}};
    std::printf("detection ratio, mean over %d keys:", keys);
    for (const Column& c : columns)
        std::printf(" | %s", c.title);
    std::printf("\n");
    for (const char* mesh : {"bunny00.off", "armadillo.off"})
        for (const EmbedOptions& options :
             {options_of(Method::Spectral, Statistic::Mean, 0), options_of(Method::Cho, Statistic::Mean, 0.05),
              options_of(Method::Cho, Statistic::Variance, 0.05)}) {
            const Surface cover = load(mesh);
            std::vector<double> sum(std::size(columns), 0);
            for (int k = 0; k < keys; ++k) {
                const Key key = key_number(k);
                Surface marked = cover;
                (void)embed(marked, key, options);
                for (std::size_t c = 0; c < sum.size(); ++c)
                    sum[c] += ratio_after(
                        attacked(marked, columns[c].attack, columns[c].amount, columns[c].iterations, k), key, options);
            }
            std::printf("%s %s%s", mesh, name(options.carriers.method),
                        options.carriers.method == Method::Spectral ? "" : name(options.carriers.statistic));
            for (const double s : sum)
                std::printf(" %.2f", s / keys);
            std::printf("\n");
            std::fflush(stdout);
        }
}

void scale(int)
{
    std::printf("faces, seconds to embed, seconds to detect, largest resident set so far in MB\n");
    for (const int times : {0, 1, 2}) {
        Surface surface = load("bunny00.off");
        if (times > 0)
            surface = attacked(surface, Attack::Subdivide, -1, times, 0);
        const Key key = key_number(0);
        const EmbedOptions options = options_of(Method::Spectral, Statistic::Mean, 0);
        const auto seconds = [](const std::function<void()>& work) {
            const auto start = std::chrono::steady_clock::now();
            work();
            return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        };
        const double embedding = seconds([&] { (void)embed(surface, key, options); });
        const double detection = seconds([&] { (void)ratio_after(surface, key, options); });
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        std::printf("%zu %.2f %.2f %ld\n", surface.triangles.size(), embedding, detection, usage.ru_maxrss / 1024);
        std::fflush(stdout);
    }
}

} // namespace

int main(int count, char** arguments)
{
    const std::string wanted = count > 1 ? arguments[1] : "all";
    const int keys = count > 2 ? std::atoi(arguments[2]) : 5;
    const struct {
        const char* title;
        void (*print)(int);
    } tables[] = {{"readback", readback}, {"distortion", distortion}, {"attacks", attacks}, {"scale", scale}};
    for (const auto& table : tables)
        if (wanted == "all" || wanted == table.title)
            table.print(keys);
}
