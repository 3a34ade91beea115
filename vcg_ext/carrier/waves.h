// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../key/key.h"
#include "../payload/message.h"
#include "wave_body.h"

#include <complex>
#include <vector>

namespace vcg_ext {

constexpr double shortest_wave = 10; ///< |q|: waves of .63 r, some .14 of a diagonal
constexpr double longest_wave = 20;

/// The waves that carry the bits, one each, as both sides draw them from the key. Bit b of wave k asks for
/// m_k = D (integer + dither_k + b / 2), where m_k = 1 / (4 pi) * integral over the solid of cos(q_k . x + phase_k).
struct WavePlan {
    Points vectors;              ///< q_k: uniform in the shell 10 <= |q| <= 20, radians per radius of the solid's ball
    std::vector<double> phases;  ///< in [0, 2 pi)
    std::vector<double> dithers; ///< in [0, 1)

    [[nodiscard]] int count() const { return static_cast<int>(vectors.size()); }
};

[[nodiscard]] WavePlan wave_plan(const Key& key, int count);

/// Wave vectors, uniform in the shell. \param draws three numbers a trial, until there are enough
[[nodiscard]] Points wave_vectors(Stream& draws, int count);

/// The step D in which a displacement of `strength` (RMS over the diagonal) is to be expected if waves go nine tenths
/// of the way to their targets, on a ladder of four rungs an octave: D = strength sqrt(12) A r^-3 diagonal / (4 pi) /
/// sqrt(2 K) / .9. A wave of amplitude a over the whole surface A changes its own m by a A / (8 pi r^3) in canonical
/// units, targets are uniform within half a step, and K waves add up.
///
/// \param rung the result's place on the ladder
[[nodiscard]] double wave_step(const WaveBody& body, double strength, int waves, int* rung = nullptr);

/// 2^(rung / 4)
[[nodiscard]] double step_of_rung(int rung);

constexpr double usual_part = 0.9;  ///< of the way to their lattice that waves go, more or less
constexpr double rung_fall = 0.577; ///< of a reader's weight, from the rung that is expected to its neighbours

/// The m_k of a body's transform at its waves. \param mirrored of the body's mirror image
[[nodiscard]] std::vector<double> wave_values_of(const std::vector<std::complex<double>>& transform,
                                                 const std::vector<double>& phases, bool mirrored);

/// One way to lay a body into the waves, and to count in steps: the phases, and how processing may have shifted them.
struct WaveView {
    int orientation = 0; ///< number in WaveBody::turns
    bool mirrored = false;
    int rung = 0;
    double step = 0;           ///< D
    double log_weight = 0;     ///< of the view; all sum to 1
    std::vector<double> phase; ///< m_k / D - dither_k: near b / 2 plus an integer where the mark is
    std::vector<double> bend;  ///< d phase / dt: RMS of half a period per unit
    std::vector<double> relax; ///< d phase / du, square to `bend`
    /// `phase` after smoothing is undone, one for each of wave_grid().undone, up to where that tears the body.
    std::vector<std::vector<double>> undone;
};

/// Which shifts (t, u) a reading tries, and their weights, which sum to 1: fixed before looking.
///
/// A quarter of the weight is for the body as it is. Half is for shifts by t along `bend` and u along `relax`. The
/// last is for smoothing with uniform weights, (1 + lambda L)^k: it is undone for products lambda k of a given list by
/// six terms of the binomial series of (1 + lambda L)^-k, lambda = 1/2; there `t` shifts a little along `bend`.
struct WaveGrid {
    struct Row {
        int undone = -1; ///< which phases it starts from: `undone[i]`, or -1 for `phase`
        double t = 0;    ///< of the whole row, at rest
        double first = 0;
        std::vector<double> log_weight; ///< of u (t where undone) = first, first + step, ...
    };
    double step = 0;
    std::vector<double> undone; ///< lambda k
    std::vector<Row> rows;
};

[[nodiscard]] const WaveGrid& wave_grid();

class WaveSpectra; // wave_spectra.h

/// All that the detector has to know of a body under a key.
struct WaveReading {
    std::vector<WaveView> views;
    const WaveGrid* grid = nullptr;
};

struct WaveReadOptions {
    double strength = 1e-4; ///< that the mark was made with, as far as the reader knows
    int lowest_rung = -2;   ///< that it tries, from that strength's own,
    int highest_rung = 2;   ///< and the highest; the nearer to its own, the more weight
    bool mirrored = true;   ///< mirror images too
    /// Only the body as it is, without what processing does to it: the weights are the same, so p is as true, and no
    /// lower. Some six times as fast, so worth a try first.
    bool at_rest_only = false;
};

/// Lays the body into the waves in every way, and computes from the body itself how processing shifts its phases.
/// Never looks at bits.
[[nodiscard]] WaveReading read_waves(WaveSpectra& spectra, const WavePlan& plan, const WaveReadOptions& options = {});

/// A view and a point of its grid.
struct WaveWay {
    int view = 0;
    int undone = -1; ///< of WaveGrid
    double t = 0;
    double u = 0;
    double log_weight = 0; ///< of the way among all
};

/// y_k of a way, in periods.
[[nodiscard]] std::vector<double> wave_phases(const WaveReading& reading, const WaveWay& way);

/// What the key alone says: whether phases gather at bits, whichever these are.
struct WavePresence {
    double log_p = 0;        ///< natural logarithm of a true bound of the probability without this mark
    double log_evidence = 0; ///< of the sum over ways of weight / tail
    WaveWay way;             ///< the best; chosen without a look at any bit
};

/// min over ways of tail(S) / weight, S = sum of cos 4 pi y_k: the dithers are secret, so without this mark y is
/// uniform in each way.
[[nodiscard]] WavePresence wave_presence(const WaveReading& reading);

/// How well the phases match bits that are expected.
struct WaveMatch {
    double log_p = 0; ///< natural logarithm of a true bound
    WaveWay way;
    double sum = 0; ///< sum of cos 2 pi (y_k - b_k / 2) there
};

/// min over ways of P(sum of +-l_k >= sum of l_k (-1)^b_k) / w, l_k = cos 2 pi y_k, w a weight of the way.
///
/// Given all y, the signs of l_k against the bits are fair coins, because the mask is secret. So this holds for any
/// mesh without a mark of this key (of one with another message they are where the two differ); and weights may look at
/// y: half of them is as before looking, half goes by weight / tail of wave_presence(), which is next to all for the way
/// where phases gather. Not below 2^-K: what the phases' gathering itself is worth, wave_presence() says.
///
/// \pre the mask that `coded` was XOR-ed with is uniform and independent of the plan
[[nodiscard]] WaveMatch wave_match(const WaveReading& reading, const WavePresence& presence, const Bits& coded);

/// A way of reading as a decoder takes it.
struct WaveSoft {
    double weight = 0;        ///< posterior; never looks at bits
    std::vector<double> soft; ///< log-likelihood ratio of coded bit 1 against 0, by wave
};

/// The `most` best ways, by weight / tail of wave_presence(), the best first.
[[nodiscard]] std::vector<WaveSoft> wave_ways(const WaveReading& reading, const WavePresence& presence, int most);

/// Log-likelihood ratios of coded bit 1 against 0: -2 k cos 2 pi y_k, with the concentration k at which cos 4 pi y_k
/// has the mean that it has.
[[nodiscard]] std::vector<double> wave_soft(const std::vector<double>& phases);

} // namespace vcg_ext
