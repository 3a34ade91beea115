// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/placement/wave_reply.h"

#include "support/load.h"
#include "support/shapes.h"
#include "vcg_ext/geometry/solid_transform.h"
#include "vcg_ext/method/wave_embedding.h"

#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

/// The m_k of the body where its sites were moved, in the frame that it then has.
std::vector<double> values_of(const WaveBody& body, const Points& sites, const WavePlan& plan)
{
    Points points = body.points;
    std::copy(sites.begin(), sites.end(), points.begin());
    place_apexes(body.topology, points);
    const Frame frame = frame_again(body, points, Eigen::Matrix3d::Identity());
    std::vector<std::complex<double>> transform =
        solid_transform(canonical(frame, points), body.topology.triangles, plan.vectors, longest_wave);
    if (frame.measure < 0)
        for (auto& value : transform)
            value = -value;
    return wave_values_of(transform, plan.phases, false);
}

/// The derivative against differences: the surface is moved by one wave, and the body looked at again.
void compare_with_differences(const char* mesh, double tolerance)
{
    const WaveBody body = wave_body(load(mesh));
    const WavePlan plan = wave_plan(Key("reply"), 24);
    const WaveReply reply(body, plan);
    const Points directions = offset_directions(body);
    constexpr double step = 1e-5;
    double squares = 0;
    double errors = 0;
    for (const int wave : {0, 7, 15, 23}) {
        const std::vector<double> field = reply.field().wave(wave);
        std::array<std::vector<double>, 2> seen;
        for (const int side : {0, 1}) {
            Points sites(body.points.begin(), body.points.begin() + body.topology.sites);
            for (std::size_t v = 0; v < sites.size(); ++v)
                sites[v] += (side == 0 ? step : -step) * field[v] * directions[v];
            seen[side] = values_of(body, sites, plan);
        }
        for (int k = 0; k < plan.count(); ++k) {
            const double exact = (seen[0][k] - seen[1][k]) / (2 * step);
            squares += exact * exact;
            errors += std::pow(exact - reply.derivative()(k, wave), 2);
        }
    }
    EXPECT_LT(std::sqrt(errors / squares), tolerance) << mesh;
}

} // namespace

TEST(WaveReply, DerivativeIsThatOfTheMovedBodyInItsOwnFrame)
{
    compare_with_differences("bunny00.off", 0.03);
    compare_with_differences("fandisk.off", 0.1);
    compare_with_differences("elephant.off", 0.1);
}

TEST(WaveReply, PredictsWhatEmbeddingDoes)
{
    const Surface original = load("bunny00.off");
    const WaveBody body = wave_body(original);
    const WavePlan plan = wave_plan(Key("reply"), 64);
    Stream draws = Key("reply").stream("bits");
    Bits bits(64);
    Eigen::VectorXd signs(64);
    for (int k = 0; k < 64; ++k) {
        bits[k] = static_cast<std::uint8_t>(draws.below(2));
        signs[k] = bits[k] ? 1 : -1;
    }
    const Cover cover(original);
    const WaveEmbedding embedded = embed_waves(cover, plan, bits, 1e-4, [](const Points& p) { return p; });
    const WaveReply reply(body, plan);
    const WaveMoves moves = reply.moves(embedded.rung);
    const Eigen::VectorXd amplitudes = embedded.part / usual_part * (moves.middle + moves.per_bit * signs);
    const Points directions = offset_directions(body);
    std::vector<double> predicted(original.points.size(), 0);
    for (int k = 0; k < 64; ++k) {
        const std::vector<double> wave = reply.field().wave(k);
        for (std::size_t v = 0; v < predicted.size(); ++v)
            predicted[v] += amplitudes[k] * wave[v];
    }
    double squares = 0;
    double errors = 0;
    for (std::size_t v = 0; v < predicted.size(); ++v) {
        const Point moved = (embedded.points[v] - original.points[v]) / body.radius;
        const Point expected = body.frame.axes * directions[v] * predicted[v];
        squares += moved.squaredNorm();
        errors += (moved - expected).squaredNorm();
    }
    EXPECT_LT(std::sqrt(errors / squares), 0.05);
}
