// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/progress.h"
#include "../carrier/reading.h"
#include "../geometry/body.h"
#include "../payload/message.h"
#include "../placement/cover.h"
#include "certificate.h"
#include "copy.h"
#include "plan.h"

#include <utility>
#include <vector>

namespace vcg_ext {

struct StrengthRange {
    double usual; ///< taken where the strength is 0
    double above; ///< it must lie above this,
    double most;  ///< and may reach this
};

/// One method, as a choice at each step. Embedding and detection share all of them but the last.
struct MethodRow {
    Method method;
    const char* name;   ///< in dialogs, scripts and reports
    const char* hint;   ///< for who must choose, half a line
    const char* secret; ///< names the mask of its bits: methods that share it read each other's marks
    /// The methods that it puts on top of each other, the first always and of the others the first that fits, each
    /// with its strength (0: the user's). Itself alone for all but Layered, whose functions are empty but for strength.
    std::vector<std::pair<Method, double>> layers;
    bool has_statistic = false; ///< whether Statistic matters
    /// Moves the surface by a smooth field: how well planes stay planes is reported, and that there is a mark can be told
    /// without its bits.
    bool is_smooth = false;
    /// How it wants the body's sites numbered, where it goes from neighbour to neighbour most of its time; null: as they
    /// come.
    void (*number)(Body& body) = nullptr;
    /// Mean soft value, in standard errors, that no unmarked mesh has; 0 where that tells nothing.
    double unmarked_strength = 0;
    StrengthRange (*strength)(Statistic statistic) = nullptr;

    /// What the key decides before a mesh is seen.
    Plan (*plan)(const Key& key, const CarrierOptions& options) = nullptr;

    /// How the body lies, by itself. \throw Error where it defines no frame
    MarkFrame (*find_frame)(const Surface& surface, const Plan& plan) = nullptr;

    /// What the carriers say, in this frame.
    Readings (*read)(const Surface& surface, const Plan& plan, const MarkFrame& frame) = nullptr;

    /// With the original at hand: what it and the registered copy tell before the number of carriers is known. Null: how
    /// the original lies by itself.
    MarkFrame (*find_copy)(const Copy& copy, const Plan& plan) = nullptr;

    /// What the carriers of a copy say, given find_copy().
    Readings (*read_copy)(const Copy& copy, const Plan& plan, const MarkFrame& frame) = nullptr;

    /// Adds to a certificate what read_certified() needs of the original. Null: it would need all of it.
    /// \throw Error where the original cannot carry this method's mark
    void (*certify)(const Surface& original, const Plan& plan, Certificate& certificate) = nullptr;

    /// What the carriers of a copy say where a certificate is all that is left of the original.
    /// \throw Error where it has not what certify() adds
    Readings (*read_certified)(const CertifiedCopy& copy, const Plan& plan) = nullptr;

    /// Writes the coded bits, as many as carriers. `options.strength` is in range.
    /// \throw DoesNotFit where the mesh cannot carry them
    Marking (*embed)(const Cover& cover, const Plan& plan, const Bits& coded, const PlacementOptions& options,
                     const Progress& progress) = nullptr;
};

/// body_of(), numbered as the method is the fastest on it.
[[nodiscard]] Body body_for(const MethodRow& method, Surface surface);

/// MethodRow::find_copy, or what stands for it.
[[nodiscard]] MarkFrame find_copy(const MethodRow& method, const Copy& copy, const Plan& plan);

/// MethodRow::read_certified. \throw Error where there is none, or this certificate is another method's
[[nodiscard]] Readings read_certified(const MethodRow& method, const CertifiedCopy& copy, const Plan& plan);

/// All methods, in the order in which users choose.
[[nodiscard]] const std::vector<MethodRow>& all_methods();

/// \throw Error where there is no such method
[[nodiscard]] const MethodRow& row_of(Method method);

/// The strength as it will be used. \throw Error where it is out of the method's range
[[nodiscard]] double checked_strength(const CarrierOptions& carriers, double strength);

} // namespace vcg_ext
