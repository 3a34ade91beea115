// SPDX-License-Identifier: GPL-3.0-or-later
// Are the probabilities what they claim? Detections on unmarked meshes and on meshes marked with another key: how often
// each falls to 1e-1, 1e-2 and 1e-3, beside what it may; how often something is called present or verified (never),
// and how often the verdict speaks of another key.
//
// Each key draws its mask by itself and, in a row, looks at one mesh only: so a row's detections are independent. Of 20
// keys ten ask for one message in 64 carriers, nine for a list of eight, one for nothing at any number of carriers. On
// unmarked meshes L-M, QSP and Cho read alike, so L-M alone stands for them.
// Usage: false_alarms [KEYS A ROW] [METHODS]    (1,400 without: some 20,000 keys; Waves and Layered take a tenth of them)

#include "support/load.h"
#include "vcg_ext/base/error.h"
#include "vcg_ext/carrier/statistic.h"
#include "vcg_ext/method/methods.h"
#include "vcg_ext/watermark/watermark.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace vcg_ext;

namespace {

constexpr std::array<double, 3> levels = {1e-1, 1e-2, 1e-3};

/// How often one kind of probability was at or below each level.
struct Tally {
    int count = 0;
    std::array<int, levels.size()> below{};

    void add(double p)
    {
        ++count;
        for (std::size_t i = 0; i < levels.size(); ++i)
            below[i] += p <= levels[i];
    }

    Tally& operator+=(const Tally& other)
    {
        count += other.count;
        for (std::size_t i = 0; i < levels.size(); ++i)
            below[i] += other.below[i];
        return *this;
    }
};

enum Claim { Named, Listed, AnyOf64, AnyOfAll, Presence, Claims };
constexpr std::array<const char*, Claims> claims = {"expected", "list of 8", "key alone, 64", "key alone, Bits 0",
                                                    "presence"};

struct Row {
    std::array<Tally, Claims> tallies;
    int keys = 0;
    int found = 0; ///< present or verified
    int another_key = 0;

    Row& operator+=(const Row& other)
    {
        for (std::size_t i = 0; i < tallies.size(); ++i)
            tallies[i] += other.tallies[i];
        keys += other.keys;
        found += other.found;
        another_key += other.another_key;
        return *this;
    }
};

std::vector<Message> list()
{
    std::vector<Message> result;
    for (int i = 0; i < 8; ++i)
        result.push_back(read_message("id:" + std::to_string(i)));
    return result;
}

DetectReport look(const Surface& surface, const Key& key, CarrierOptions carriers, int bits,
                  std::vector<Message> expected, Row& row)
{
    carriers.bits = bits;
    DetectReport report = detect(surface, key, {carriers, std::move(expected)});
    row.found += report.verified || report.present.value_or(false);
    return report;
}

void look(const Surface& surface, const Key& key, const CarrierOptions& carriers, int number, Row& row)
{
    const int kind = number % 20;
    DetectReport report;
    if (kind == 0) {
        report = look(surface, key, carriers, 0, {}, row);
        row.tallies[AnyOfAll].add(report.p_message);
    } else {
        report =
            look(surface, key, carriers, 64, kind % 2 ? std::vector<Message>{read_message("id:4711")} : list(), row);
        row.tallies[kind % 2 ? Named : Listed].add(*report.p_value);
        row.tallies[AnyOf64].add(report.p_message);
    }
    if (report.presence)
        row.tallies[Presence].add(*report.presence);
    row.another_key += report.finding == Verdict::AnotherKey;
}

void print(const std::string& title, const Row& row)
{
    std::printf("%s: %d keys, %d found, %d times \"another key\"\n", title.c_str(), row.keys, row.found,
                row.another_key);
    for (int claim = 0; claim < Claims; ++claim) {
        const Tally& tally = row.tallies[claim];
        if (tally.count == 0)
            continue;
        std::printf("  %-18s %6d", claims[claim], tally.count);
        for (std::size_t i = 0; i < levels.size(); ++i)
            std::printf("   %5d of %7.1f", tally.below[i], levels[i] * tally.count);
        std::printf("\n");
    }
    std::fflush(stdout);
}

} // namespace

int main(int count, char** arguments)
{
    const int keys = count > 1 ? std::atoi(arguments[1]) : 1400;
    const std::string only = count > 2 ? arguments[2] : "";
    constexpr std::array<const char*, 5> names = {"cow.off", "femur.off", "bones.off", "blobby.off", "triceratops.off"};
    const Key owner("owner");
    std::vector<Key> strangers; // deriving one takes longer than most readings
    const auto stranger = [&strangers](int k) -> const Key& {
        while (static_cast<int>(strangers.size()) <= k) {
            strangers.emplace_back("false alarm " + std::to_string(strangers.size()));
            (void)strangers.back().stream("one after the other: each takes 64 MiB").next();
        }
        return strangers[k];
    };
    Row all;
    for (const bool marked : {false, true})
        for (const MethodRow& method : all_methods())
            for (const Statistic statistic : {Statistic::Mean, Statistic::Variance}) {
                const bool twin = !marked && (method.method == Method::QSP || method.method == Method::Cho);
                if (twin || (!method.has_statistic && statistic == Statistic::Variance) ||
                    (!only.empty() && only.find(method.name) == std::string::npos))
                    continue;
                EmbedOptions options;
                options.carriers.method = method.method;
                options.carriers.statistic = statistic;
                options.carriers.bits = 64;
                options.message = read_message("id:4711");
                Row row;
                for (std::size_t mesh = 0; mesh < names.size(); ++mesh) {
                    Surface surface = load(names[mesh]);
                    try {
                        if (marked)
                            embed(surface, owner, options);
                    } catch (const Error&) {
                        continue; // refused
                    }
                    const int here = row_of(method.layers.front().first).method == Method::Waves ? keys / 10 : keys;
                    for (int k = static_cast<int>(mesh); k < here; k += names.size())
                        try {
                            look(surface, stranger(k), options.carriers, static_cast<int>(k / names.size()), row);
                            ++row.keys;
                        } catch (const Error&) {
                            // refused: no claim
                        }
                }
                print(std::string(marked ? "another key, " : "unmarked, ") + method.name + " " +
                          (method.has_statistic ? name(statistic) : ""),
                      row);
                all += row;
            }
    print("all", all);
}
