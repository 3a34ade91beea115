// SPDX-License-Identifier: GPL-3.0-or-later
// Are p-values what they claim? Detections on unmarked meshes and on meshes marked with another key: how often p falls
// to 1e-1, 1e-2, 1e-3, against the exact chance of that, which for 64 bits is a step below each.
//
// Each key draws its mask by itself and, in a row, looks at one mesh only: so a row's detections are independent. One
// message is embedded and looked for throughout: what makes chance of the matches must be the key's mask alone.
// On unmarked meshes L-M, QSP and Cho read alike: their rows are the same detections, and count once.
// Usage: false_alarms [KEYS]    (900 without: more than 10,000 detections, each counted once)

#include "support/load.h"
#include "vcg_ext/base/error.h"
#include "vcg_ext/carrier/statistic.h"
#include "vcg_ext/method/methods.h"
#include "vcg_ext/payload/binomial.h"
#include "vcg_ext/watermark/watermark.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace vcg_ext;

namespace {

constexpr std::array<double, 3> levels = {1e-1, 1e-2, 1e-3};
constexpr int bits = 64;

struct Tally {
    int detections = 0;
    int present = 0;
    std::array<int, levels.size()> below{};
};

/// The chance that a p-value is at most `level`: the largest binomial tail that is; times 4, where p is the best of 4.
double claimed(double level, int tries)
{
    for (int matches = 0; matches <= bits; ++matches)
        if (tries * binomial_tail(bits, matches) <= level)
            return tries * binomial_tail(bits, matches);
    return 0;
}

void print(const char* title, const Tally& tally, int tries)
{
    std::printf("%-28s %7d", title, tally.detections);
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const double chance = claimed(levels[i], tries);
        const double expected = chance * tally.detections;
        std::printf("   %5d %8.1f %5.1f", tally.below[i], expected,
                    (tally.below[i] - expected) / std::sqrt(expected * (1 - chance)));
    }
    std::printf("   %d\n", tally.present);
}

} // namespace

int main(int count, char** arguments)
{
    const int number_of_keys = count > 1 ? std::atoi(arguments[1]) : 900;
    constexpr std::array<const char*, 5> names = {"cow.off", "femur.off", "bones.off", "blobby.off", "triceratops.off"};
    const Message message = read_message("hex:0123456789abcdef");
    std::vector<Key> keys;
    for (int i = 0; i < number_of_keys; ++i)
        keys.emplace_back("false alarm " + std::to_string(i));
    const Key owner("owner");

    std::printf("%-28s %7s", "", "calls");
    for (const double level : levels)
        std::printf("   p<=%-5g expected sigma", level);
    std::printf("   present\n");
    for (const bool marked : {false, true})
        for (const MethodRow& row : all_methods())
            for (const Statistic statistic : {Statistic::Mean, Statistic::Variance}) {
                const Method method = row.method;
                if (!row.has_statistic && statistic == Statistic::Variance)
                    continue;
                Tally tally;
                for (std::size_t mesh = 0; mesh < names.size(); ++mesh) {
                    Surface surface;
                    try {
                        surface = load(names[mesh]);
                        if (marked) {
                            EmbedOptions options;
                            options.carriers.method = method;
                            options.carriers.statistic = statistic;
                            options.message = message;
                            embed(surface, owner, options);
                        }
                    } catch (const std::exception&) {
                        continue; // refused
                    }
                    for (std::size_t k = mesh; k < keys.size(); k += names.size()) {
                        DetectOptions options;
                        options.carriers.method = method;
                        options.carriers.statistic = statistic;
                        options.expected = {message};
                        try {
                            const DetectReport found = detect(surface, keys[k], options);
                            ++tally.detections;
                            tally.present += *found.present;
                            for (std::size_t i = 0; i < levels.size(); ++i)
                                tally.below[i] += *found.p_value <= levels[i];
                        } catch (const Error&) {
                            // refused: no claim
                        }
                    }
                }
                const std::string title = std::string(marked ? "another key, " : "unmarked, ") + name(method) + " " +
                                          (row.has_statistic ? name(statistic) : "");
                print(title.c_str(), tally, row.method == Method::Spectral ? 4 : 1);
                std::fflush(stdout);
            }
}
