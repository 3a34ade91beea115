// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "wave_grid.h"
#include "wave_spectra.h"

namespace vcg_ext {

constexpr double rung_fall = 0.577; ///< of a reader's weight, from the rung that is expected to its neighbours

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

} // namespace vcg_ext
