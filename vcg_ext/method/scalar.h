#pragma once
#include "../base/progress.h"
#include "../base/surface.h"
#include "../carrier/carriers.h"
#include "../carrier/statistic.h"

#include <functional>

namespace vcg_ext {

/// A method that hides bits in one scalar per vertex, as a choice at each step: which scalar, read how, placed how.
struct ScalarMethod {
    Carriers cover; ///< of the unmarked surface
    /// The same, were there `count` of them.
    std::function<Carriers(int count)> cut;
    /// Per vertex how much of a move to ask of it, see map_histogram(); 0: it must not move.
    std::vector<double> mobility;
    double guard = 0; ///< part of a carrier's width that values must keep from its ends, for the frame's own sake
    /// Positions in which the scalar of each vertex is as near as can be to its target; a NaN target lets it stay.
    std::function<Points(const std::vector<double>& targets)> place;
    /// The carriers as a blind detector finds them in other positions of the same vertices.
    std::function<Carriers(const Points& stored)> read;
    /// Takes up the frame that the detector found in `stored`, and returns the cover's carriers in it; may be empty.
    /// Marking moves the frame a little. Aiming in the marked frame takes that out of the next round.
    std::function<Carriers(const Points& stored)> reframe;
};

struct ScalarResult {
    Points points;               ///< as placed, not yet rounded
    std::vector<double> margins; ///< per carrier: how far on its bit's side of the threshold it reads; negative: wrong
    int rounds = 0;
};

/// The closed loop: map the histogram of every carrier, place, round as stored, read blind; carriers that read wrong or
/// weak get a target further out and another round. Returns the best round, judged by its worst carrier.
///
/// \param bits  per carrier the bit that it is to carry
/// \param alpha distance of the target from the threshold, (4.8) and (5.7)
/// \param guard part of a carrier's width that values keep from its ends
/// \param round what storing does to positions
[[nodiscard]] ScalarResult embed_scalar(const ScalarMethod& method, Statistic statistic, const std::vector<char>& bits,
                                        double alpha, double guard, int max_rounds,
                                        const std::function<Points(const Points&)>& round, const Progress& progress);

} // namespace vcg_ext
