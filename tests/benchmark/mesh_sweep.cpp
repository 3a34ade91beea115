// SPDX-License-Identifier: GPL-3.0-or-later
// Every mesh of libcgal-demo by every method: marked and read back, or refused with a reason; anything else must not
// be. Where embedding names a number of bits that the mesh carries, that number is tried too.
//
// Each job runs in a process of its own with a limit of processor time, so that a crash or a hang is seen, and only
// counted once; a busy machine makes no hang.
// Ends with an error where a method marked hardly any mesh, too.
// Usage: mesh_sweep [--stl] [--every N] [--seconds N] [--marked N] [--method NAME] [--verbose]
//   --stl      each saved as a binary STL file, and opened from that
//   --every N  each Nth mesh only
//   --marked N meshes that each method must mark at least; 1 without

#include "support/load.h"
#include "vcg_ext/base/error.h"
#include "vcg_ext/carrier/statistic.h"
#include "vcg_ext/method/methods.h"
#include "vcg_ext/watermark/watermark.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dirent.h>
#include <functional>
#include <map>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace vcg_ext;

namespace {

enum Outcome { marked, refused, wrong, crashed, hung, outcomes };
constexpr const char* outcome_names[] = {"marked", "refused", "wrong", "crashed", "hung"};

struct Settings {
    bool stl = false;
    bool verbose = false;
    int every = 1;
    int seconds = 120;
    int marked = 1;
    std::string method; ///< this one only; empty: all
};

struct Job {
    Method method;
    Statistic statistic;
};

/// Every method with each of its statistics.
std::vector<Job> all_jobs(const std::string& method)
{
    std::vector<Job> jobs;
    for (const MethodRow& row : all_methods()) {
        if (!method.empty() && method != row.name)
            continue;
        jobs.push_back({row.method, Statistic::Mean});
        if (row.has_statistic)
            jobs.push_back({row.method, Statistic::Variance});
    }
    return jobs;
}

std::vector<std::string> all_meshes()
{
    std::vector<std::string> names;
    DIR* folder = opendir(DATA_DIR);
    while (const dirent* entry = folder ? readdir(folder) : nullptr)
        if (entry->d_name[0] != '.')
            names.emplace_back(entry->d_name);
    if (folder)
        closedir(folder);
    std::sort(names.begin(), names.end());
    return names;
}

bool same(const Points& a, const Points& b)
{
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Point)) == 0); // NaN is NaN here
}

/// What became of one try, and the text of an error.
std::pair<Outcome, std::string> try_to_mark(const Surface& cover, const Key& key, const EmbedOptions& options,
                                            int* carries = nullptr)
{
    Surface stego = cover;
    try {
        const EmbedReport report = embed(stego, key, options);
        DetectOptions reading;
        reading.carriers = options.carriers;
        reading.expected = {options.message};
        if (!std::all_of(stego.points.begin(), stego.points.end(), [](const Point& p) { return p.allFinite(); }))
            return {wrong, "coordinates that are not finite"};
        if (detect(stego, key, reading).bits != report.bits)
            return {wrong, "other bits were read"};
        return {marked, ""};
    } catch (const DoesNotFit& error) {
        if (carries)
            *carries = carriers_that_fit(cover, key, options, error);
        return {same(stego.points, cover.points) ? refused : wrong, error.what()};
    } catch (const Error& error) {
        return {same(stego.points, cover.points) ? refused : wrong, error.what()};
    } catch (const std::exception& error) {
        return {wrong, std::string("another kind of exception: ") + error.what()};
    }
}

std::pair<Outcome, std::string> run(const Surface& cover, const Key& key, const Job& job)
{
    EmbedOptions options;
    options.carriers.bits = 64;
    options.carriers.method = job.method;
    options.carriers.statistic = job.statistic;
    options.message = read_message("hex:0123456789abcdef");
    options.message.kind = Kind::Bits;
    DetectOptions reading;
    reading.carriers = options.carriers;
    reading.expected = {options.message};
    try {
        if (*detect(cover, key, reading).present)
            return {wrong, "a mark was found in the unmarked mesh"};
    } catch (const Error&) {
        // a refusal; other exceptions end this process
    }
    int carries = 0;
    auto result = try_to_mark(cover, key, options, &carries);
    if (result.first == refused && carries > 0) {
        options.carriers.bits = carries;
        options.message.bits.resize(carries);
        const auto [outcome, text] = try_to_mark(cover, key, options);
        if (outcome != marked)
            return {wrong, "the number named does not work: " + result.second + " / " + text};
    }
    return result;
}

/// Runs `work` in another process. What that process can still say it says through a pipe.
std::pair<Outcome, std::string> apart(int seconds, const std::function<std::pair<Outcome, std::string>()>& work)
{
    int ends[2];
    if (pipe(ends) != 0)
        std::abort();
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        const auto most = static_cast<rlim_t>(seconds);
        const rlimit limit{most, most + 1};
        setrlimit(RLIMIT_CPU, &limit);
        alarm(100 * static_cast<unsigned>(seconds)); // where it waits for ever
        const auto [outcome, text] = work();
        const std::string line = static_cast<char>('0' + outcome) + text;
        const bool told = write(ends[1], line.data(), line.size()) == static_cast<ssize_t>(line.size());
        _exit(told ? 0 : 1);
    }
    close(ends[1]);
    std::string line;
    char buffer[4096];
    for (ssize_t got = 0; (got = read(ends[0], buffer, sizeof buffer)) > 0;)
        line.append(buffer, static_cast<std::size_t>(got));
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGALRM))
        return {hung, "more than " + std::to_string(seconds) + " s"};
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || line.empty())
        return {crashed, "status " + std::to_string(status)};
    return {static_cast<Outcome>(line[0] - '0'), line.substr(1)};
}

} // namespace

int main(int count, char** arguments)
{
    Settings settings;
    for (int i = 1; i < count; ++i) {
        const std::string argument = arguments[i];
        const auto number = [&] { return i + 1 < count ? std::atoi(arguments[++i]) : 0; };
        if (argument == "--stl")
            settings.stl = true;
        else if (argument == "--verbose")
            settings.verbose = true;
        else if (argument == "--every")
            settings.every = std::max(1, number());
        else if (argument == "--seconds")
            settings.seconds = std::max(1, number());
        else if (argument == "--marked")
            settings.marked = std::max(1, number());
        else if (argument == "--method" && i + 1 < count)
            settings.method = arguments[++i];
        else
            return std::fprintf(stderr,
                                "usage: mesh_sweep [--stl] [--every N] [--seconds N] [--marked N] [--verbose]\n"),
                   2;
    }

    const Key key("mesh_sweep");
    [[maybe_unused]] const auto derived = key.stream("before any fork: a child has no threads to wait for").next();
    const std::vector<Job> jobs = all_jobs(settings.method);
    std::vector<std::array<int, outcomes>> counts(jobs.size());
    std::map<std::string, int> reasons;
    const std::vector<std::string> names = all_meshes();
    int meshes = 0;
    for (std::size_t m = 0; m < names.size(); m += static_cast<std::size_t>(settings.every)) {
        // What an importer does to a file is no part of the count.
        const auto [loaded, why] = apart(20, [&]() -> std::pair<Outcome, std::string> {
            try {
                return {load(names[m]).points.empty() ? refused : marked, "no vertices"};
            } catch (const std::exception& error) {
                return {refused, error.what()};
            }
        });
        if (loaded != marked) {
            std::printf("%s is left out, its importer %s: %s\n", names[m].c_str(), outcome_names[loaded], why.c_str());
            continue;
        }
        Surface cover = load(names[m]);
        ++meshes;
        if (settings.stl)
            cover = through_stl(cover);
        for (std::size_t j = 0; j < jobs.size(); ++j) {
            const auto [outcome, text] = apart(settings.seconds, [&] { return run(cover, key, jobs[j]); });
            ++counts[j][outcome];
            if (outcome == refused)
                ++reasons[text];
            if (outcome > refused || (settings.verbose && outcome == refused))
                std::printf("%s, %s %s: %s: %s\n", names[m].c_str(), name(jobs[j].method), name(jobs[j].statistic),
                            outcome_names[outcome], text.c_str());
        }
    }

    std::printf("\n%d of %zu meshes%s, 64 bits\n%-18s", meshes, names.size(), settings.stl ? " from STL files" : "",
                "");
    for (const char* outcome : outcome_names)
        std::printf(" %8s", outcome);
    std::printf("\n");
    int failures = 0;
    for (std::size_t j = 0; j < jobs.size(); ++j) {
        std::printf("%-9s%-9s", name(jobs[j].method), name(jobs[j].statistic));
        for (int outcome = 0; outcome < outcomes; ++outcome) {
            std::printf(" %8d", counts[j][outcome]);
            failures += outcome > refused ? counts[j][outcome] : 0;
        }
        if (counts[j][marked] < settings.marked) {
            std::printf("  marked fewer than %d", settings.marked);
            ++failures;
        }
        std::printf("\n");
    }
    std::printf("\nReasons of the refusals:\n");
    for (const auto& [text, times] : reasons)
        std::printf("%5d  %s\n", times, text.c_str());
    return failures == 0 ? 0 : 1;
}
