// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../carrier/reading.h"
#include "../payload/message.h"
#include "closed_loop.h"
#include "plan.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

namespace vcg_ext {

/// The reading of carriers that are sets of vertices with one scalar each.
[[nodiscard]] Readings read_carriers(Carriers carriers, const Plan& plan);

/// The reading of the carriers of a part, beside those of the original and the vertices of it that are left in the part.
///
/// A part of a carrier has not the statistic of the whole, marked or not: by how much the original's own part differs
/// from the original's whole is taken off (a control variate).
[[nodiscard]] Readings read_part(Carriers part, const Carriers& original, const std::vector<char>& left,
                                 const Plan& plan);

/// The scalar that each vertex is to have, NaN where it stays: every carrier's histogram mapped to its target, but for
/// those that are beyond it already.
class TargetScalars {
public:
    /// \param cover, bits must outlive this; bits are per carrier   \param mobility per vertex, see map_histogram()
    /// \param guard part of a carrier's width that values keep from its ends
    TargetScalars(const Carriers& cover, std::vector<double> mobility, const std::vector<char>& bits,
                  Statistic statistic, double guard);

    /// \param targets per carrier, each at least as far out as the last time; who has the same one is not mapped again
    [[nodiscard]] const std::vector<double>& at(const std::vector<double>& targets);

private:
    void map(int k, double target);

    const Carriers& cover_;
    std::vector<double> mobility_;
    const std::vector<char>& bits_;
    Statistic statistic_;
    double guard_;
    std::vector<double> now_;   ///< per carrier its statistic on the cover
    std::vector<int> first_;    ///< per carrier where its vertices begin in
    std::vector<int> vertices_; ///< all that are in one, carrier by carrier, ascending
    std::vector<double> asked_; ///< per carrier the target that its scalars are for
    std::vector<double> scalars_;
};

/// The statistic that each carrier is to have: alpha beyond the threshold, on the side of its bit, and further out where
/// it does not read as it should.
class CarrierTargets {
public:
    /// \param coded as many bits as carriers
    CarrierTargets(const Bits& coded, const Plan& plan, double alpha);

    /// Per carrier.
    [[nodiscard]] const std::vector<char>& bits() const { return bits_; }
    [[nodiscard]] const std::vector<double>& now() const { return targets_; }

    /// Per carrier how far it reads beyond what is enough; negative where it is to be pushed.
    [[nodiscard]] std::vector<double> margins(const Carriers& read) const;

    /// Pushes carriers by what they lack. Where folds hold vertices back, a push brings but a share of what it asks for;
    /// the next one reckons with that.
    void push(const std::vector<double>& margins);

    /// How many carriers read the wrong bit.
    [[nodiscard]] std::ptrdiff_t wrong(const std::vector<double>& margins) const;

private:
    [[nodiscard]] double side(std::size_t k) const { return bits_[k] ? 1 : -1; }

    std::vector<char> bits_;
    Statistic statistic_;
    double alpha_;
    std::vector<double> targets_;
    std::vector<double> pushed_; ///< by the last push
    std::vector<double> last_;   ///< margins before it
};

/// Carriers, as many as can be found by doubling `count` and then halving the interval, of which none is empty.
/// \param cut `cut(count)`: the cover's carriers, were there so many
[[nodiscard]] int count_of_filled(int count, const std::function<Carriers(int)>& cut);

/// Vertices in the poorest carrier. \param cut see count_of_filled()
/// \throw DoesNotFit where one is empty
[[nodiscard]] int checked_samples(const Carriers& carriers, const std::function<Carriers(int)>& cut);

/// What storing does to the positions of this cover, and the part of a carrier that values must keep from its ends for
/// it.
struct Storing {
    Rounding round;
    double guard = 0;
    std::optional<std::string> warning;
};

/// \throw Error where float is coarser than the carriers and `storage` is Float
[[nodiscard]] Storing storing(const Points& points, const Carriers& carriers, Storage storage);

/// The closed loop of the methods that have one scalar per vertex: map the histogram of every carrier, place, round as
/// stored, read blind; carriers that read wrong or weak get a target further out and another round.
///
/// Marking moves the frame a little. So the second round aims in the frame that the detector found after the first.
///
/// \param scalar which scalar, how read and how placed:
///   - `find(points)`            the frame, as a blind detector finds it in other positions of the cover's vertices
///   - `read(points, frame)`     the carriers, as it reads them there
///   - `on_cover(points, frame)` that frame, carried over to the cover
///   - `aim(frame)`              from now on, and in it:
///   - `cut(count)`              the cover's carriers
///   - `mobility()`              how much of a move to ask of each vertex; 0: it must not move
///   - `place(targets)`          a Proposal in which each vertex' scalar is as near as can be to its target
///   - `guard`                   part of a carrier's width that values keep from its ends, for the frame's own sake
/// \param coded the bits to be written, as many as carriers
template <class Scalar>
Marking embed_scalar(Scalar& scalar, const Cover& cover, const Plan& plan, const Bits& coded,
                     const PlacementOptions& options, const Progress& progress)
{
    Marking marking;
    const int count = plan.options.bits;
    scalar.aim(scalar.find(cover.points));
    Carriers carriers = scalar.cut(count);
    const auto cut = [&scalar](int wanted) { return scalar.cut(wanted); };
    marking.samples_min = checked_samples(carriers, cut);
    marking.capacity = count_of_filled(count, cut);
    const Storing store = storing(cover.points, carriers, options.storage);
    if (store.warning)
        marking.warnings.push_back(*store.warning);
    const double guard = std::max({store.guard, scalar.guard, 1e-6});

    CarrierTargets targets(coded, plan, options.strength);
    std::vector<double> margins = targets.margins(carriers);
    const auto worst = [&margins] { return *std::min_element(margins.begin(), margins.end()); };
    if (worst() >= 0) { // the mark is there already
        marking.kept.points = cover.points;
        return marking;
    }

    std::optional<TargetScalars> aims;
    const auto aim_at_targets = [&] {
        aims.emplace(carriers, scalar.mobility(), targets.bits(), plan.options.statistic, guard);
    };
    aim_at_targets();
    Proposal placed;
    const auto place_and_read = [&](int round) {
        placed = {}; // before the next one takes as much
        placed = scalar.place(aims->at(targets.now()));
        const Points stored = store.round(placed.points);
        const auto frame = scalar.find(stored);
        margins = targets.margins(scalar.read(stored, frame));
        if (round > 1) { // single carriers, in a frame that holds still
            targets.push(margins);
        } else if (worst() < 0) {
            scalar.aim(scalar.on_cover(stored, frame));
            carriers = scalar.cut(count);
            aim_at_targets();
        }
        return worst();
    };
    std::ptrdiff_t wrong = 0;
    marking.rounds = closed_loop(options.max_rounds, "Placing vertices", progress, place_and_read, [&] {
        marking.kept = std::move(placed);
        wrong = targets.wrong(margins);
    });
    if (wrong > 0)
        throw DoesNotFit(std::to_string(wrong) + " of the " + std::to_string(count) +
                             " carriers could not be read back.",
                         marking.capacity);
    return marking;
}

} // namespace vcg_ext
