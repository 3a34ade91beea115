// SPDX-License-Identifier: GPL-3.0-or-later
// How plainly marks of vertex norms are seen without their key: for each mesh what find_comb() says of it, of copies that
// a user made, and of copies with a mark. The share of both that counts as marked. Prints Markdown.
//
//   second_mark [mesh ...]     all of the data folder that have 1,000 to 100,000 vertices without

#include "support/load.h"
#include "vcg_ext/attack/attack.h"
#include "vcg_ext/base/stopwatch.h"
#include "vcg_ext/carrier/comb.h"
#include "vcg_ext/carrier/shells.h"
#include "vcg_ext/geometry/body.h"
#include "vcg_ext/watermark/watermark.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

using namespace vcg_ext;

namespace {

Comb comb_of(const Surface& surface)
{
    const Body body = body_of(surface);
    const ShellFrame frame = shell_frame(body.surface);
    return find_comb(norms(body.surface.points, frame.centre), frame.minimum, frame.maximum);
}

struct Tally {
    int seen = 0;
    int all = 0;
    double most = 0;   ///< contrast
    double least = 99; ///< likewise

    void add(const Surface& surface, const char* mesh, const char* what)
    {
        try {
            const Comb comb = comb_of(surface);
            ++all;
            seen += comb.found();
            most = std::max(most, comb.strength > 1.6 ? comb.contrast : 1);
            least = std::min(least, comb.contrast);
            std::printf("| %s | %s | %.2f | %.2f | %s |\n", mesh, what, comb.strength, comb.contrast,
                        comb.found() ? "yes" : "");
        } catch (const Error&) { // no body, or a sphere
        }
    }
};

void add_copies(const Surface& plain, const char* mesh, Tally& tally)
{
    tally.add(plain, mesh, "unmarked");
    for (const Attack attack : {Attack::Noise, Attack::Smooth, Attack::Simplify, Attack::Quantize, Attack::Subdivide}) {
        Surface copy = plain;
        AttackOptions options;
        options.attack = attack;
        try {
            apply_attack(copy, options);
        } catch (const Error&) {
            continue;
        }
        tally.add(copy, mesh, name(attack));
    }
}

void add_marked(const Surface& plain, const char* mesh, Method method, Statistic statistic, Tally& tally)
{
    Surface copy = plain;
    EmbedOptions options;
    options.carriers.method = method;
    options.carriers.statistic = statistic;
    options.message = read_message("id:4711");
    try {
        embed(copy, key_from_text(std::string("owner of ") + mesh), options);
    } catch (const Error&) {
        return;
    }
    tally.add(copy, mesh, (std::string(name(method)) + " " + name(statistic)).c_str());
}

} // namespace

int main(int argc, char** argv)
{
    std::vector<std::string> meshes(argv + 1, argv + argc);
    if (meshes.empty())
        for (const auto& entry : std::filesystem::directory_iterator(DATA_DIR))
            meshes.push_back(entry.path().filename().string());
    std::sort(meshes.begin(), meshes.end());
    Tally unmarked;
    Tally marked;
    std::printf("| mesh | copy | strength | contrast | found |\n|---|---|---|---|---|\n");
    for (const std::string& mesh : meshes) {
        Surface plain;
        try {
            plain = load(mesh);
        } catch (const std::exception&) {
            continue;
        }
        if (plain.points.size() < 1000 || plain.points.size() > 100000)
            continue;
        add_copies(plain, mesh.c_str(), unmarked);
        for (const Statistic statistic : {Statistic::Mean, Statistic::Variance})
            for (const Method method : {Method::LM, Method::QSP, Method::Cho})
                add_marked(plain, mesh.c_str(), method, statistic, marked);
        std::fflush(stdout);
    }
    std::printf("\nunmarked: %d of %d found, contrast up to %.2f\nmarked: %d of %d found, from %.2f\n", unmarked.seen,
                unmarked.all, unmarked.most, marked.seen, marked.all, marked.least);
}
