// SPDX-License-Identifier: GPL-3.0-or-later
// How often embedding by vertex norms reads every bit back from the float coordinates that it wrote, and what became of
// the rest: refused with a reason, or (never) lost. Four meshes, six methods, 20 keys, 32 to 256 bits.

#include "support/load.h"
#include "vcg_ext/base/error.h"
#include "vcg_ext/carrier/statistic.h"
#include "vcg_ext/watermark/watermark.h"

#include <cstdio>
#include <set>

using namespace vcg_ext;

int main()
{
    std::vector<Key> keys;
    for (int i = 0; i < 20; ++i)
        keys.emplace_back("readback " + std::to_string(i));
    std::set<std::string> reasons;
    for (const char* mesh : {"bunny00.off", "fandisk.off", "armadillo.off", "refined_elephant.off"}) {
        const Surface cover = load(mesh);
        for (const int bits : {32, 64, 128, 256})
            for (const Method method : {Method::Cho, Method::QSP, Method::LM})
                for (const Statistic statistic : {Statistic::Mean, Statistic::Variance}) {
                    int whole = 0, refused = 0, lost = 0, rounds = 0, weak = 0;
                    for (const Key& key : keys) {
                        EmbedOptions options;
                        options.carriers.method = method;
                        options.carriers.statistic = statistic;
                        options.carriers.bits = bits;
                        options.message = read_message("hex:0123456789abcdef");
                        options.message.kind = Kind::Bits;
                        options.message.bits.resize(bits, 1);
                        Surface stego = cover;
                        try {
                            const EmbedReport report = embed(stego, key, options);
                            rounds += report.rounds;
                            weak += !report.warnings.empty();
                            DetectOptions read;
                            read.carriers = options.carriers;
                            (detect(stego, key, read).bits == report.bits ? whole : lost) += 1;
                        } catch (const Error& error) {
                            reasons.insert(error.what());
                            ++refused;
                        }
                    }
                    std::printf("%-22s %3d bits %-4s%-9s whole %2d  refused %2d  lost %d  weak %d  rounds %.1f\n", mesh,
                                bits, name(method), name(statistic), whole, refused, lost, weak,
                                whole > 0 ? static_cast<double>(rounds) / whole : 0);
                }
    }
    for (const std::string& reason : reasons)
        std::printf("%s\n", reason.c_str());
}
