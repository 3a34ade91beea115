// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../method/marking.h"
#include "../payload/message.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vcg_ext {

struct EmbedReport {
    Method method{};
    Statistic statistic{};
    Bits bits;           ///< what was embedded, padded to the number of carriers
    double strength = 0; ///< as used
    double trim = 0;     ///< as used
    int carriers = 0;
    int samples_min = 0;        ///< vertices in the poorest carrier
    int capacity = 0;           ///< see Marking
    double detection_ratio = 0; ///< of the blind self-check: 1, or embed() throws
    int rounds = 0;
    int moved_vertices = 0;
    int guarded_vertices = 0;    ///< see Proposal
    double max_displacement = 0; ///< of the positions as stored, like the two that follow
    double mrms = 0;
    double mrms_relative = 0;              ///< over the bounding box's diagonal
    std::map<std::string, double> seconds; ///< by phase
    std::optional<SolverSummary> solver;   ///< Method::LM only
    std::optional<MoveCounts> moves;       ///< Method::Geodesic only
    std::vector<std::string> warnings;
};

struct DetectReport {
    Method method{};
    Statistic statistic{};
    double trim = 0;
    Bits bits;
    /// Per bit: the statistic's distance from the threshold in standard errors, positive for 1.
    std::vector<double> soft;
    std::vector<int> samples;              ///< per bit: vertices in its carrier
    std::optional<double> detection_ratio; ///< matching bits over all; with an expected message only
    /// Binomial tail of at least that many matches by chance, over the weight of the way of reading that was taken.
    std::optional<double> p_value;
    std::optional<bool> present;         ///< p_value below 1e-6
    std::optional<int> smoothing_rounds; ///< of the surface before it was read; Method::Geodesic only
    std::map<std::string, double> seconds;
    std::vector<std::string> warnings;
    /// Spectral: whether axis 1 and axis 2 were read along (+) or against (-) the body's third moments, as "++" or "-+".
    std::string orientation;
    std::vector<int> carrier_of_vertex; ///< per vertex the number of the bit it carries, or -1
};

} // namespace vcg_ext
