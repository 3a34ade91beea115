// SPDX-License-Identifier: GPL-3.0-or-later
// What is left of a message after each attack: mean detection ratio over several keys, of the vertex-norm methods.
// Usage: robustness [Mean|Variance] [keys] [mesh.off ...]

#include "rows.h"
#include "support/load.h"
#include "vcg_ext/carrier/statistic.h"
#include "vcg_ext/key/stream.h"
#include "vcg_ext/payload/binomial.h"
#include "vcg_ext/watermark/watermark.h"

#include <cstdio>
#include <cstdlib>

using namespace vcg_ext;

namespace {

const std::vector<Row>& rows()
{
    static const std::vector<Row> all = [] {
        std::vector<Row> list = blind_rows();
        list.push_back({"crop 30 %", {{Attack::Crop, 0.3}}});
        list.push_back({"affine 1 %", {{Attack::Affine, 0.01}}});
        return list;
    }();
    return all;
}

constexpr std::array methods = {Method::LM, Method::QSP, Method::Cho};
constexpr int carriers = 64;

/// Ratio of every attack (rows) of every method (columns), under one key.
std::vector<std::array<double, methods.size()>> ratios(const Surface& cover, Statistic statistic, int number)
{
    const Key key("robustness " + std::to_string(number));
    Stream draws = key.stream("message");
    Bits message;
    for (int i = 0; i < carriers; ++i)
        message.push_back(static_cast<std::uint8_t>(draws.below(2)));

    std::vector<std::array<double, methods.size()>> result(rows().size());
    for (std::size_t m = 0; m < methods.size(); ++m) {
        EmbedOptions embedding;
        embedding.carriers.method = methods[m];
        embedding.carriers.statistic = statistic;
        embedding.carriers.bits = carriers;
        embedding.message = {Kind::Bits, message, {}};
        embedding.carriers.trim = 0.1;
        Surface stego = cover;
        embed(stego, key, embedding);
        for (std::size_t r = 0; r < rows().size(); ++r) {
            Surface attacked = stego;
            spoil(attacked, rows()[r], number);
            DetectOptions detection;
            detection.carriers = embedding.carriers;
            result[r][m] = static_cast<double>(matching_bits(message, detect(attacked, key, detection).bits)) /
                           static_cast<double>(message.size());
        }
    }
    return result;
}

} // namespace

int main(int argc, char** argv)
{
    const Statistic statistic = argc > 1 && std::string(argv[1]) == "Variance" ? Statistic::Variance : Statistic::Mean;
    const int keys = argc > 2 ? std::atoi(argv[2]) : 5;
    std::vector<std::string> meshes(argv + std::min(argc, 3), argv + argc);
    if (meshes.empty())
        meshes = {"bunny00.off", "fandisk.off"};
    for (const std::string& mesh : meshes) {
        const Surface cover = load(mesh);
        std::vector<std::array<double, methods.size()>> mean(rows().size());
        for (int number = 0; number < keys; ++number) {
            const auto one = ratios(cover, statistic, number);
            for (std::size_t r = 0; r < mean.size(); ++r)
                for (std::size_t m = 0; m < methods.size(); ++m)
                    mean[r][m] += one[r][m] / keys;
        }
        std::printf("%s, %s, %d bits, trim 0.1, %d keys\n%-22s", mesh.c_str(), name(statistic), carriers, keys, "");
        for (const Method method : methods)
            std::printf("%6s", name(method));
        std::printf("\n");
        for (std::size_t r = 0; r < mean.size(); ++r) {
            std::printf("%-22s", rows()[r].label.c_str());
            for (const double ratio : mean[r])
                std::printf("%6.2f", ratio);
            std::printf("\n");
        }
        std::fflush(stdout);
    }
}
