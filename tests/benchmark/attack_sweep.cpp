// SPDX-License-Identifier: GPL-3.0-or-later
// Every attack on every mesh, each in a process of its own with limits on time and memory: a result, a refusal, or what
// must not be. Takes the names of meshes, or runs all of them. Ends with an error where something crashed or did not
// end, or an attack was refused by all meshes.

#include "support/load.h"
#include "vcg_ext/attack/attack.h"
#include "vcg_ext/base/error.h"
#include "vcg_ext/metric/distortion.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace vcg_ext;

namespace {

enum class Outcome { Result, Refusal, Wrong, Crash, TooLong };

constexpr unsigned seconds_of_processor = 300;
constexpr unsigned long long bytes_of_memory = 8ull << 30;

bool is_sound(const Surface& surface)
{
    const int vertices = static_cast<int>(surface.points.size());
    return !surface.triangles.empty() &&
           std::all_of(surface.points.begin(), surface.points.end(), [](const Point& p) { return p.allFinite(); }) &&
           std::all_of(surface.triangles.begin(), surface.triangles.end(), [vertices](const Triangle& t) {
               return std::all_of(t.begin(), t.end(), [vertices](int v) { return v >= 0 && v < vertices; });
           });
}

/// The attack, and the measure of what it did. Writes the reason of a refusal to `out`.
Outcome attack_and_measure(const Surface& original, Attack attack, FILE* out)
{
    Surface surface = original;
    try {
        apply_attack(surface, {attack, -1, attack == Attack::Remesh ? 3 : -1, 1});
        if (!is_sound(surface))
            return Outcome::Wrong;
        const DistortionReport r = measure(original, surface, {2000, 1});
        if (!std::isfinite(r.mrms) || !std::isfinite(r.hausdorff) || !std::isfinite(r.msdm.value_or(0)))
            return Outcome::Wrong;
        return Outcome::Result;
    } catch (const Error& error) {
        std::fprintf(out, "%s", error.what());
        return Outcome::Refusal;
    } catch (const std::exception& error) {
        std::fprintf(out, "%s", error.what());
        return Outcome::Wrong;
    }
}

Outcome in_a_process(const Surface& original, Attack attack, std::string& reason)
{
    FILE* text = std::tmpfile();
    const pid_t child = fork();
    if (child == 0) {
        const rlimit time = {seconds_of_processor, seconds_of_processor};
        const rlimit memory = {bytes_of_memory, bytes_of_memory};
        setrlimit(RLIMIT_CPU, &time);
        setrlimit(RLIMIT_AS, &memory);
        const Outcome outcome = attack_and_measure(original, attack, text);
        std::fflush(text);
        _exit(static_cast<int>(outcome));
    }
    int status = 0;
    waitpid(child, &status, 0);
    char line[400] = "";
    std::rewind(text);
    if (std::fgets(line, sizeof line, text))
        reason = line;
    std::fclose(text);
    if (WIFEXITED(status) && WEXITSTATUS(status) <= static_cast<int>(Outcome::Wrong))
        return static_cast<Outcome>(WEXITSTATUS(status));
    reason = WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : "an exit of its own";
    return WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL) ? Outcome::TooLong
                                                                                               : Outcome::Crash;
}

std::vector<std::string> all_meshes()
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(DATA_DIR))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

} // namespace

int main(int argc, char** argv)
{
    const std::vector<std::string> meshes = argc > 1 ? std::vector<std::string>(argv + 1, argv + argc) : all_meshes();
    std::map<Attack, std::map<Outcome, int>> counts;
    int loaded = 0;
    for (const std::string& mesh : meshes) {
        Surface original;
        try {
            original = load(mesh);
        } catch (const std::exception& error) {
            std::printf("%s does not load: %s\n", mesh.c_str(), error.what());
            continue;
        }
        ++loaded;
        for (const Attack attack : all_attacks()) {
            std::string reason;
            const Outcome outcome = in_a_process(original, attack, reason);
            ++counts[attack][outcome];
            constexpr const char* words[] = {"result", "refused", "WRONG", "CRASH", "TOO LONG"};
            if (outcome != Outcome::Result)
                std::printf("%s %s %s: %s\n", mesh.c_str(), name(attack), words[static_cast<int>(outcome)],
                            reason.c_str());
            std::fflush(stdout);
        }
    }
    std::printf("%d of %zu meshes loaded\n%-12s %8s %8s %8s %8s %8s\n", loaded, meshes.size(), "attack", "result",
                "refused", "wrong", "crash", "too long");
    int bad = 0;
    for (auto& [attack, count] : counts) {
        std::printf("%-12s %8d %8d %8d %8d %8d\n", name(attack), count[Outcome::Result], count[Outcome::Refusal],
                    count[Outcome::Wrong], count[Outcome::Crash], count[Outcome::TooLong]);
        bad += count[Outcome::Result] == 0;
        bad += count[Outcome::Wrong] + count[Outcome::Crash] + count[Outcome::TooLong];
    }
    return bad > 0 || loaded == 0 ? 1 : 0;
}
