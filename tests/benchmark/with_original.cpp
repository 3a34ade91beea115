// SPDX-License-Identifier: GPL-3.0-or-later
// What detect_with_original(), or detect_with_certificate(), says after each chain of attacks: share of the carriers that match, log10 of p_value and
// p_message, how the mesh was registered, seconds.
// Usage: with_original METHOD [--strength 0] [--message TEXT] [--keys 1] [--first-key 1] [--row TEXT] [--unmarked]
//                      [--wrong-key] [--certificate] [mesh.off ...]

#include "rows.h"
#include "support/load.h"
#include "vcg_ext/method/methods.h"
#include "vcg_ext/watermark/watermark.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace vcg_ext;

namespace {

const std::vector<Row>& rows()
{
    const AttackOptions similarity{Attack::Similarity};
    const AttackOptions noise{Attack::Noise, 0.001};
    static const std::vector<Row> all = {
        {"none", {{Attack::Reorder}}},
        {"crop 10 %, noise, similarity", {{Attack::Crop, 0.1}, noise, similarity}},
        {"crop 30 %, noise, similarity", {{Attack::Crop, 0.3}, noise, similarity}},
        {"crop 50 %, noise, similarity", {{Attack::Crop, 0.5}, noise, similarity}},
        {"crop 70 %, noise, similarity", {{Attack::Crop, 0.7}, noise, similarity}},
        {"crop 30 %, simplify 50 %, noise, sim.", {{Attack::Crop, 0.3}, {Attack::Simplify, 0.5}, noise, similarity}},
        {"noise .1 %", {noise}},
        {"noise .3 %", {{Attack::Noise, 0.003}}},
        {"noise .5 %", {{Attack::Noise, 0.005}}},
        {"quantization 8", {{Attack::Quantize, 8}}},
        {"quantization 7", {{Attack::Quantize, 7}}},
        {"smoothing .5 x 10", {{Attack::Smooth, 0.5, 10}}},
        {"smoothing .5 x 50", {{Attack::Smooth, 0.5, 50}}},
        {"simplify 50 %, smoothing .5 x 10", {{Attack::Simplify, 0.5}, {Attack::Smooth, 0.5, 10}}},
        {"simplify 90 %", {{Attack::Simplify, 0.9}}},
        {"simplify 97 %", {{Attack::Simplify, 0.97}}},
        {"isosurface .5 %", {{Attack::Isosurface, 0.005}}},
        {"isosurface 1 %", {{Attack::Isosurface, 0.01}}},
        {"isosurface 2 %", {{Attack::Isosurface, 0.02}}},
        {"remeshing x2", {{Attack::Remesh, 2, 3}}},
        {"affine 2 %", {{Attack::Affine, 0.02}}},
        {"affine 5 %", {{Attack::Affine, 0.05}}},
        {"mirrored, similarity", {{Attack::Mirror}, similarity}},
        {"isosurface 1 %, crop 30 %, similarity", {{Attack::Isosurface, 0.01}, {Attack::Crop, 0.3}, similarity}},
    };
    return all;
}

struct Settings {
    EmbedOptions embed;
    const char* only = "";
    bool unmarked = false;
    bool wrong_key = false;
    bool certificate = false;
};

void table(const std::string& mesh, const Settings& settings, int number)
{
    const Key key("original " + std::to_string(number));
    const Key reader("another " + std::to_string(number));
    const Surface original = load(mesh);
    Surface stego = original;
    const EmbedReport made = embed(stego, key, settings.embed);
    std::printf("%s, %s, key %d, %d carriers, MRMS %.2e", mesh.c_str(), name(made.method), number, made.carriers,
                made.mrms_relative);
    Certificate certificate;
    if (settings.certificate) {
        const std::string bytes = bytes_of(make_certificate(original, key, settings.embed));
        certificate = certificate_of(bytes);
        std::printf(", certificate of %zu bytes", bytes.size());
    }
    std::printf("\n");
    for (const Row& row : rows()) {
        if (row.label.find(settings.only) == std::string::npos)
            continue;
        Surface suspect = settings.unmarked ? original : stego;
        try {
            spoil(suspect, row, static_cast<std::uint64_t>(number));
            const DetectOptions options{settings.embed.carriers, {settings.embed.message}};
            const Key& tried = settings.wrong_key ? reader : key;
            certificate.key_check = key_check_of(tried); // another key is refused, but here it shall be tried
            const DetectReport found = settings.certificate
                                           ? detect_with_certificate(suspect, certificate, tried, options)
                                           : detect_with_original(suspect, original, tried, options);
            const RegistrationReport& pose = *found.registration;
            std::printf("  %-38s %.3f p %6.1f message %6.1f  %s overlap %.2f residual %.1e rounds %d  %.2f + %.2f s\n",
                        row.label.c_str(), found.detection_ratio.value_or(0), std::log10(found.p_value.value_or(1)),
                        std::log10(found.p_message), pose.by.c_str(), pose.overlap, pose.residual,
                        found.smoothing_rounds.value_or(0), found.seconds.at("registration"),
                        found.seconds.at("detection"));
        } catch (const Error& error) {
            std::printf("  %-38s %s\n", row.label.c_str(), error.what());
        }
        std::fflush(stdout);
    }
}

} // namespace

int main(int count, char** arguments)
try {
    Settings settings;
    settings.embed.message = read_message("id:4711");
    int keys = 1;
    int first = 1;
    std::vector<std::string> meshes;
    for (int i = 1; i < count; ++i) {
        const std::string word = arguments[i];
        const bool more = i + 1 < count;
        if (word == "--strength" && more)
            settings.embed.placement.strength = std::atof(arguments[++i]);
        else if (word == "--message" && more)
            settings.embed.message = read_message(arguments[++i]);
        else if (word == "--keys" && more)
            keys = std::atoi(arguments[++i]);
        else if (word == "--first-key" && more)
            first = std::atoi(arguments[++i]);
        else if (word == "--row" && more)
            settings.only = arguments[++i];
        else if (word == "--unmarked")
            settings.unmarked = true;
        else if (word == "--wrong-key")
            settings.wrong_key = true;
        else if (word == "--certificate")
            settings.certificate = true;
        else if (i == 1) {
            for (const MethodRow& row : all_methods())
                if (word == row.name)
                    settings.embed.carriers.method = row.method;
        } else
            meshes.push_back(word);
    }
    if (meshes.empty())
        meshes = {"bunny00.off", "armadillo.off", "fandisk.off", "refined_elephant.off"};
    for (const std::string& mesh : meshes)
        for (int number = first; number < first + keys; ++number)
            table(mesh, settings, number);
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
