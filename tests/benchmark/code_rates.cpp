// SPDX-License-Identifier: GPL-3.0-or-later
// Frame error rates of the payload code over the binary-input Gaussian channel, as CSV.
// `code_rates small | curves | lengths | proofs | all [frames]`, or `code_rates length FRAMES BITS CARRIERS`
//   small: beside exhaustive maximum likelihood; curves: beside the normal approximation (Polyanskiy, Poor and Verdu
//   2010); lengths: the distance to it at a frame error rate of 1e-2, and milliseconds a decode, for many n and K;
//   proofs: where the key alone proves what it reads.

#include "vcg_ext/key/random.h"
#include "vcg_ext/payload/code.h"
#include "vcg_ext/payload/evidence.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

using namespace vcg_ext;

namespace {

/// Standard deviation of the noise on +-1 at Es/N0 in dB.
double noise_at(double decibel)
{
    return std::sqrt(0.5 * std::pow(10, -decibel / 10));
}

double normal(Stream& stream)
{
    const double radius = std::sqrt(-2 * std::log(1 - uniform(stream)));
    return radius * std::cos(2 * std::acos(-1.0) * uniform(stream));
}

/// Frame error rate Q((K C - n + log2(K) / 2) / sqrt(K V)) of the best code of n bits in K carriers.
double normal_approximation(int bits, int carriers, double decibel)
{
    const double sigma = noise_at(decibel);
    double weights = 0, capacity = 0, square = 0;
    for (double z = -8; z <= 8; z += 0.01) {
        const double weight = std::exp(-z * z / 2);
        const double density = 1 - std::log2(1 + std::exp(-2 * (1 + sigma * z) / (sigma * sigma)));
        weights += weight;
        capacity += weight * density;
        square += weight * density * density;
    }
    capacity /= weights;
    const double dispersion = square / weights - capacity * capacity;
    const double excess = carriers * capacity - bits + std::log2(carriers) / 2;
    return std::erfc(excess / std::sqrt(2 * carriers * dispersion)) / 2;
}

struct Frame {
    Bits message;
    std::vector<double> soft;
};

Frame frame(const PolarCode& code, double decibel, Stream& stream)
{
    Frame result;
    for (int i = 0; i < code.bits; ++i)
        result.message.push_back(static_cast<std::uint8_t>(stream.below(2)));
    const double sigma = noise_at(decibel);
    for (const std::uint8_t bit : polar_encode(code, result.message))
        result.soft.push_back((bit ? 1 : -1) + sigma * normal(stream));
    return result;
}

struct Rate {
    double errors = 0;   ///< part of the frames that were read wrong
    double likelier = 0; ///< part whose wrong word agrees better than the sent one: maximum likelihood errs there too
    double milliseconds = 0;
};

Rate rate(const PolarCode& code, double decibel, int frames, int list, int most_errors = 1 << 30)
{
    using Clock = std::chrono::steady_clock;
    Stream stream = seeded_stream(1, "code-rates");
    Rate result;
    int done = 0;
    for (; done < frames && result.errors < most_errors; ++done) {
        const Frame sent = frame(code, decibel, stream);
        const auto start = Clock::now();
        const Bits found = polar_decode(code, sent.soft, list);
        result.milliseconds += std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        if (found == sent.message)
            continue;
        ++result.errors;
        result.likelier +=
            agreement(polar_encode(code, found), sent.soft) >= agreement(polar_encode(code, sent.message), sent.soft);
    }
    return {result.errors / done, result.likelier / done, result.milliseconds / done};
}

double maximum_likelihood(const PolarCode& code, double decibel, int frames)
{
    std::vector<Bits> words;
    for (int number = 0; number < 1 << code.bits; ++number) {
        Bits message;
        for (int i = 0; i < code.bits; ++i)
            message.push_back(number >> i & 1);
        words.push_back(polar_encode(code, message));
    }
    Stream stream = seeded_stream(1, "code-rates");
    int errors = 0;
    for (int i = 0; i < frames; ++i) {
        const Frame sent = frame(code, decibel, stream);
        const double right = agreement(polar_encode(code, sent.message), sent.soft);
        errors += std::any_of(words.begin(), words.end(),
                              [&](const Bits& word) { return agreement(word, sent.soft) > right + 1e-9; });
    }
    return static_cast<double>(errors) / frames;
}

void small(int frames)
{
    const int sizes[][2] = {{8, 32}, {10, 24}, {12, 64}};
    for (const auto& [bits, carriers] : sizes)
        for (double decibel = -6; decibel <= 0; ++decibel) {
            const PolarCode code = polar_code(bits, carriers);
            std::printf("small,%d,%d,32,%.2f,%.5f,%.5f,%.5f\n", bits, carriers, decibel,
                        rate(code, decibel, frames, 32).errors, maximum_likelihood(code, decibel, frames),
                        normal_approximation(bits, carriers, decibel));
            std::fflush(stdout);
        }
}

void curves(int frames)
{
    const int sizes[][2] = {{32, 64}, {64, 128}, {128, 256}};
    for (const auto& [bits, carriers] : sizes)
        for (const int list : {1, 32, 128})
            for (double decibel = -3.5; decibel <= 1; decibel += 0.5) {
                const double ideal = normal_approximation(bits, carriers, decibel);
                if (ideal > 0.7 || ideal < 1e-4)
                    continue;
                const Rate found = rate(polar_code(bits, carriers), decibel, frames, list, 400);
                std::printf("curve,%d,%d,%d,%.2f,%.5f,%.5f,%.5f\n", bits, carriers, list, decibel, found.errors,
                            found.likelier, ideal);
                std::fflush(stdout);
            }
}

/// Es/N0 at which `falling` passes 1e-2, by bisection.
template <class Function>
double threshold(double low, double high, int steps, const Function& falling)
{
    for (int step = 0; step < steps; ++step) {
        const double middle = (low + high) / 2;
        (falling(middle) > 1e-2 ? low : high) = middle;
    }
    return (low + high) / 2;
}

void length(int bits, int carriers, int frames)
{
    const double ideal = threshold(-15, 15, 40, [&](double d) { return normal_approximation(bits, carriers, d); });
    const PolarCode code = polar_code(bits, carriers);
    double milliseconds = 0;
    const double real = threshold(ideal - 0.3, ideal + 1.7, 5, [&](double d) {
        const Rate found = rate(code, d, frames, 32, frames / 40);
        milliseconds = found.milliseconds;
        return found.errors;
    });
    std::printf("length,%d,%d,32,%.2f,%.2f,%.2f,%.2f\n", bits, carriers, ideal, real, real - ideal, milliseconds);
    std::fflush(stdout);
}

void lengths(int frames)
{
    for (const int carriers : {64, 96, 128, 192, 256, 384, 512, 768, 1024}) {
        const int some = carriers > 256 ? frames / 3 : frames;
        length(carriers / 2, carriers, some);
        length(carriers / 4, carriers, some);
        if (carriers > 64 && carriers <= 384 && carriers != 128)
            length(32, carriers, some);
    }
}

/// Part of the frames whose message is right and proven with the key alone, p_message < 1e-6.
double proven(int bits, int carriers, double decibel, int frames)
{
    double weight = 1;
    for (const Hypothesis& way : hypotheses(carriers))
        if (way.bits == bits && way.kind == Kind::Text)
            weight = way.weight;
    const Code code(bits, carriers, Kind::Text);
    Stream stream = seeded_stream(1, "code-rates");
    const double sigma = noise_at(decibel);
    int found = 0;
    for (int i = 0; i < frames; ++i) {
        const Bits message(bits, 1);
        std::vector<double> soft;
        for (const std::uint8_t bit : code.encode(message))
            soft.push_back((bit ? 1 : -1) + sigma * normal(stream));
        const double p = log_any_message(log_tail(soft, agreement(code.encode(message), soft)), bits);
        found += p - std::log10(weight) < -6 && code.decode(soft) == message;
    }
    return static_cast<double>(found) / frames;
}

void proofs(int frames)
{
    const int sizes[][2] = {{16, 64},  {24, 64},  {32, 64},  {32, 96},  {32, 128},
                            {64, 128}, {64, 192}, {64, 256}, {104, 256}};
    for (const auto& [bits, carriers] : sizes) {
        const auto at = [&, bits = bits, carriers = carriers](double part) {
            return threshold(-9, 9, 6, [&](double d) { return proven(bits, carriers, d, frames) < part ? 1.0 : 0.0; });
        };
        const double ideal = threshold(-15, 15, 40, [&, bits = bits, carriers = carriers](double d) {
            return normal_approximation(bits, carriers, d);
        });
        std::printf("proof,%d,%d,32,%.2f,%.2f,%.2f,\n", bits, carriers, at(0.5), at(0.95), ideal);
        std::fflush(stdout);
    }
}

} // namespace

int main(int argc, char** argv)
{
    const std::string what = argc > 1 ? argv[1] : "all";
    const int frames = argc > 2 ? std::atoi(argv[2]) : 4000;
    std::printf("table,bits,carriers,list,esn0_db,error_rate,maximum_likelihood,normal_approximation\n");
    if (what == "small" || what == "all")
        small(frames);
    if (what == "curves" || what == "all")
        curves(frames);
    if (what == "lengths" || what == "all") {
        std::printf("# length: bits, carriers, list, Es/N0 in dB of the normal approximation at 1e-2, of the code, "
                    "difference, ms a decode\n");
        lengths(frames);
    }
    if (what == "proofs" || what == "all") {
        std::printf(
            "# proof: bits, carriers, list, Es/N0 in dB at which the key alone proves 1 of 2 messages and 19 of 20, "
            "of the normal approximation at 1e-2\n");
        proofs(std::max(frames / 20, 100));
    }
    if (what == "length" && argc > 4)
        length(std::atoi(argv[3]), std::atoi(argv[4]), frames);
}
