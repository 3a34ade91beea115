// SPDX-License-Identifier: GPL-3.0-or-later
// What detect() says after each attack: log10 of p_value, p_message and presence, and the verdict.
// Usage: survival METHOD [--bits 0] [--strength 0] [--message TEXT] [--keys 1] [--row TEXT] [mesh.off ...]

#include "rows.h"
#include "support/load.h"
#include "vcg_ext/method/methods.h"
#include "vcg_ext/metric/distortion.h"
#include "vcg_ext/watermark/watermark.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace vcg_ext;

namespace {

double log10_of(const std::optional<double>& p)
{
    return p ? std::log10(std::max(*p, 1e-300)) : 0;
}

void table(const std::string& mesh, const EmbedOptions& options, int number, const char* only)
{
    const Key key("survival " + std::to_string(number));
    const Surface cover = load(mesh);
    Surface stego = cover;
    const EmbedReport made = embed(stego, key, options);
    DistortionOptions sampling;
    sampling.samples = 100000;
    const DistortionReport change = measure(cover, stego, sampling);
    std::printf("%s, %s, key %d, %d carriers: MRMS %.2e, MSDM %.3f; layers", mesh.c_str(), name(made.method), number,
                made.carriers, change.mrms_relative, change.msdm.value_or(0));
    for (const Method layer : made.layers)
        std::printf(" %s", name(layer));
    std::printf("; %.2f s and %.2f s for the check\n", made.seconds.at("placement"), made.seconds.at("check"));
    for (const std::string& warning : made.warnings)
        std::printf("  (%s)\n", warning.c_str());
    for (const Row& row : blind_rows()) {
        if (row.label.find(only) == std::string::npos)
            continue;
        Surface suspect = stego;
        try {
            spoil(suspect, row, static_cast<std::uint64_t>(number));
            const DetectReport found = detect(suspect, key, {options.carriers, {options.message}});
            std::printf("  %-20s p %7.1f  key alone %7.1f  presence %7.1f  %5.2f s  %s\n", row.label.c_str(),
                        log10_of(found.p_value), log10_of(found.p_message), log10_of(found.presence),
                        found.seconds.at("detection"), found.verdict.c_str());
        } catch (const Error& error) {
            std::printf("  %-20s %s\n", row.label.c_str(), error.what());
        }
        std::fflush(stdout);
    }
}

} // namespace

int main(int count, char** arguments)
try {
    EmbedOptions options;
    options.message = read_message("id:4711");
    int keys = 1;
    const char* only = "";
    std::vector<std::string> meshes;
    for (int i = 1; i < count; ++i) {
        const std::string word = arguments[i];
        const bool more = i + 1 < count;
        if (word == "--bits" && more)
            options.carriers.bits = std::atoi(arguments[++i]);
        else if (word == "--strength" && more)
            options.placement.strength = std::atof(arguments[++i]);
        else if (word == "--message" && more)
            options.message = read_message(arguments[++i]);
        else if (word == "--keys" && more)
            keys = std::atoi(arguments[++i]);
        else if (word == "--row" && more)
            only = arguments[++i];
        else if (i == 1) {
            for (const MethodRow& row : all_methods())
                if (word == row.name)
                    options.carriers.method = row.method;
        } else
            meshes.push_back(word);
    }
    if (meshes.empty())
        meshes = {"bunny00.off", "armadillo.off", "refined_elephant.off", "fandisk.off"};
    for (const std::string& mesh : meshes)
        for (int number = 1; number <= keys; ++number)
            table(mesh, options, number, only);
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
