// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/progress.h"

#include <limits>

namespace vcg_ext {

/// The closed loop of every method: place, round as stored, read as the detector will, and again, until every carrier
/// has margin.
///
/// \param round `round(number)`, from 1 on: makes it, and returns the worst carrier's margin, 0 and more where no
///              further round is wanted
/// \param keep  called after the first round, and after each that reads better than all before it
/// \return rounds that were made
template <class Round, class Keep>
int closed_loop(int max_rounds, const char* phase, const Progress& progress, const Round& round, const Keep& keep)
{
    int made = 0;
    double best = -std::numeric_limits<double>::infinity();
    while (made < max_rounds && best < 0) {
        report(progress, 20 + 60 * made / max_rounds, phase);
        const double worst = round(++made);
        if (made == 1 || worst > best) {
            best = worst;
            keep();
        }
    }
    return made;
}

} // namespace vcg_ext
