// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/error.h"
#include "../base/progress.h"
#include "../carrier/wave_plan.h"
#include "../payload/message.h"
#include "../placement/cover.h"

#include <functional>

namespace vcg_ext {

/// What embed_waves() did.
struct WaveEmbedding {
    Points points;    ///< marked and rounded, one a vertex of the cover
    double step = 0;  ///< D
    int rung = 0;     ///< its place on the ladder
    double part = 0;  ///< of the way to its lattice that every m_k goes
    int rounds = 0;   ///< of the closed loop
    double worst = 0; ///< the largest distance of an m_k from its target, in steps
    double moved = 0; ///< RMS displacement over the surface, over the diagonal
    int guarded = 0;  ///< vertices held back because a face would have folded
};

/// Moves the surface by the least smooth field that brings every wave's m_k towards its lattice, all by the same part of
/// the way, as far as `strength` allows. In a closed loop: guard against folds, round as stored, take the marked solid's
/// own frame, correct; until every m_k is within .025 D of where it shall be.
///
/// \param cover    welded
/// \param coded    one bit a wave: those of the message, encoded and masked
/// \param strength RMS displacement over the diagonal that is to be expected; the step goes by it
/// \param round    what storing does to positions
/// \throw Error where the body has no axes of its own (three equal variances), or the mesh is too coarse for the waves;
///        the text names the wave
[[nodiscard]] WaveEmbedding embed_waves(const Cover& cover, const WavePlan& plan, const Bits& coded, double strength,
                                        const std::function<Points(const Points&)>& round,
                                        const Progress& progress = {});

} // namespace vcg_ext
