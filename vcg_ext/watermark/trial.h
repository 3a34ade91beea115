// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/progress.h"
#include "../key/key.h"
#include "judge.h"
#include "options.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace vcg_ext {

constexpr double log10_sure = -6; ///< of the probability below which a finding is told as one

/// How often carriers are counted, and what share of the doubt each count may use.
struct Count {
    int carriers;
    double weight;
    bool quick; ///< see CarrierOptions
};

/// All of one count of carriers that is worth comparing with others.
struct Trial {
    Count count{};
    std::vector<LayerReading> layers;
    Judgement judgement;
    double trim = 0;
    std::vector<std::string> warnings;

    /// log10 of a bound, this count's share taken off: so it holds for whichever count is chosen after looking.
    [[nodiscard]] double after_share(double log10_p) const { return std::min(0.0, log10_p - std::log10(count.weight)); }
};

/// What all counts come to.
struct Search {
    Trial best;                ///< that says the most
    double log10_any = 0;      ///< that any message reads as well
    double log10_expected = 0; ///< that one of those expected does
};

/// Reads with each number of carriers that the options leave open, till one is sure.
/// \param share of all false alarms that may be this search's
/// \throw Error where no layer can read this surface, or the expected message is too long for the number given
[[nodiscard]] Search try_counts(const LayerReader& read, const Key& key, const DetectOptions& options, double share,
                                const Progress& progress);

} // namespace vcg_ext
