// SPDX-License-Identifier: GPL-3.0-or-later
// How long a message is read with the key alone after an attack: the largest number of bits at which 19 of 20 keys give
// the right message with a probability below 1e-6, beside the largest at which plain repetition gives the right bits in
// 19 of 20 (which proves nothing).
//
// A mark of half as many bits as carriers is made, attacked and read once a key. Which carriers that leaves right, and
// how surely, is laid over a random word of each other length: the codes are cosets of linear ones, so that is what a
// mark of that length would have met.
// Usage: payload_rates [METHOD] [CARRIERS] [KEYS] [mesh.off]

#include "rows.h"
#include "support/load.h"
#include "vcg_ext/key/random.h"
#include "vcg_ext/method/methods.h"
#include "vcg_ext/payload/code.h"
#include "vcg_ext/watermark/judge.h"
#include "vcg_ext/watermark/watermark.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>

using namespace vcg_ext;

namespace {

const std::vector<Row>& rows()
{
    static const std::vector<Row> all =
        blind_rows({"noise .1 %", "noise .3 %", "quantization 8", "simplification 50 %", "remeshing x1"});
    return all;
}

Bits random_bits(int count, Stream& stream)
{
    Bits bits;
    for (int i = 0; i < count; ++i)
        bits.push_back(static_cast<std::uint8_t>(stream.below(2)));
    return bits;
}

Message message_of(int bits, Stream& stream)
{
    return {Kind::Hex, random_bits(bits, stream), {}};
}

/// Per carrier the soft value, positive where the carrier is right.
std::vector<double> channel(const DetectReport& found, const Bits& embedded)
{
    std::vector<double> rightness = found.soft;
    for (std::size_t k = 0; k < rightness.size(); ++k)
        rightness[k] *= embedded[k] ? 1 : -1;
    return rightness;
}

std::vector<double> through(const std::vector<double>& rightness, const Bits& word)
{
    std::vector<double> soft = rightness;
    for (std::size_t k = 0; k < soft.size(); ++k)
        soft[k] *= word[k] ? 1 : -1;
    return soft;
}

bool coded_reads(const std::vector<double>& rightness, int bits, Stream& stream)
{
    const int carriers = static_cast<int>(rightness.size());
    const Message message = message_of(bits, stream);
    LayerReading layer{Method::LM, {}, Bits(carriers, 0)};
    layer.readings.ways.emplace_back();
    layer.readings.ways.back().soft = through(rightness, encode(message, carriers));
    const Judgement::Read best = judge({layer}, carriers, {}).best;
    return best.log10_p < -6 && best.kind != Kind::Id && best.bits == message.bits;
}

bool repetition_reads(const std::vector<double>& rightness, int bits)
{
    std::vector<double> sum(bits, 0);
    for (std::size_t k = 0; k < rightness.size(); ++k)
        sum[k % bits] += rightness[k];
    return std::all_of(sum.begin(), sum.end(), [](double value) { return value > 0; });
}

/// The largest length that all but a twentieth of the channels read; 0 where there is none.
template <class Reads>
int longest(const std::vector<std::vector<double>>& channels, int carriers, const Reads& reads)
{
    int best = 0;
    for (int bits = 8; bits <= carriers; bits += 8) {
        std::size_t read = 0;
        for (const std::vector<double>& rightness : channels)
            read += reads(rightness, bits);
        if (20 * read >= 19 * channels.size())
            best = bits;
    }
    return best;
}

void table(const MethodRow& method, int carriers, int keys, const Surface& cover)
{
    std::map<std::string, std::vector<std::vector<double>>> channels;
    for (int number = 0; number < keys; ++number) {
        const Key key("payload " + std::to_string(number));
        Stream stream = seeded_stream(number, "payload-rates");
        EmbedOptions options;
        options.carriers.method = method.method;
        options.carriers.bits = carriers;
        options.message = message_of(carriers / 2, stream);
        Surface stego = cover;
        const EmbedReport made = embed(stego, key, options);
        for (const Row& row : rows()) {
            Surface suspect = stego;
            spoil(suspect, row, number);
            channels[row.label].push_back(channel(detect(suspect, key, {options.carriers, {}}), made.bits));
        }
    }
    for (const Row& row : rows()) {
        Stream stream = seeded_stream(0, "payload-rates-words");
        const auto coded = [&](const std::vector<double>& rightness, int bits) {
            return bits + 20 <= carriers && coded_reads(rightness, bits, stream);
        };
        std::printf("%-9s %4d carriers  %-20s coded %4d  repeated %4d\n", method.name, carriers, row.label.c_str(),
                    longest(channels[row.label], carriers, coded),
                    longest(channels[row.label], carriers, repetition_reads));
    }
    std::fflush(stdout);
}

} // namespace

int main(int count, char** arguments)
try {
    const std::string only = count > 1 ? arguments[1] : "";
    const int carriers = count > 2 ? std::atoi(arguments[2]) : 0;
    const int keys = count > 3 ? std::atoi(arguments[3]) : 20;
    const Surface cover = load(count > 4 ? arguments[4] : "bunny00.off");
    for (const MethodRow& method : all_methods())
        for (const int number : {64, 128})
            if ((only.empty() || only == method.name) && (carriers == 0 || carriers == number))
                table(method, number, keys, cover);
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
