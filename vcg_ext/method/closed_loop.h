// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/progress.h"
#include "marking.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace vcg_ext {

struct LoopResult {
    Proposal kept;               ///< the round whose worst carrier reads best
    std::vector<double> margins; ///< its margins
    int rounds = 0;              ///< that were made
};

/// The closed loop of every method: place, round as stored, read as the blind detector will, and again, until every
/// carrier has margin.
///
/// \param propose  `propose(round)`, rounds from 1 on: a Proposal
/// \param read     `read(stored, round)`: per carrier its margin, 0 and more where no further round is wanted; may
///                 correct what the next proposal aims at
template <class Propose, class Read>
LoopResult closed_loop(int max_rounds, const Rounding& stored, const Propose& propose, const Read& read,
                       const char* phase, const Progress& progress)
{
    LoopResult result;
    double best = -std::numeric_limits<double>::infinity();
    for (int round = 1; round <= max_rounds && best < 0; ++round) {
        report(progress, 20 + 60 * (round - 1) / max_rounds, phase);
        Proposal proposal = propose(round);
        std::vector<double> margins = read(stored(proposal.points), round);
        const double worst = *std::min_element(margins.begin(), margins.end());
        result.rounds = round;
        if (worst > best || round == 1) {
            best = worst;
            result.kept = std::move(proposal);
            result.margins = std::move(margins);
        }
    }
    return result;
}

} // namespace vcg_ext
