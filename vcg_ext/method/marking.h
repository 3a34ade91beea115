// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/error.h"
#include "../base/surface.h"
#include "../carrier/statistic.h"
#include "../placement/front.h"
#include "../placement/sphere.h"
#include "method.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace vcg_ext {

constexpr int most_carriers = 1024;

/// What embedding and detection must agree on, besides the key.
struct CarrierOptions {
    Method method = Method::Layered;
    Statistic statistic = Statistic::Mean; ///< Spectral ignores it
    int bits = 0; ///< number of carriers, 1 to 1024; 0: embedding takes what the message needs, detection looks for it
    /// eps of (5.2), Spectral: alpha_trim of (3.6): part of the range cut off at both ends, 0 to 0.45; -1: drawn from
    /// the key.
    double trim = -1;
    /// Spectral: chapter 3 as the thesis prints it, for comparison. Patches of Algorithm 1 with their own Laplacians,
    /// exact eigenbases (up to 2,500 vertices a patch), the highest 70 %, (3.21), T = 2.25, no guard against folds.
    bool as_printed = false;
    /// Detection: only look for marks that nothing was done to but a similarity; for numbers of carriers that are tried
    /// on the side.
    bool quick = false;

    /// \throw Error where a value is out of its range
    void check() const;
};

/// Which scalar the written file will hold. The blind self-check reads the coordinates as they will be stored.
enum class Storage { Float, Double };

/// How a mark is put in; detection does not depend on it.
struct PlacementOptions {
    /// Waves and Layered: MRMS over the diagonal that is to be expected, 2e-5 to 2e-3. Vertex norms and Geodesic:
    /// alpha, in (0, 0.45] for Mean and (0, 0.3] for Variance; for Spectral K, above 2 and up to 1000.
    /// 0: the method's default, 1e-4, 0.1 and 15.
    double strength = 0;
    Storage storage = Storage::Float; ///< where it is Double, the mark is still checked after rounding to float
    int max_rounds = 10;              ///< rounds of correction before embedding gives up, at least 1
    SphereOptions sphere;             ///< for Method::LM
    FrontScheme front_scheme = FrontScheme::PredictCorrect; ///< for Method::Geodesic

    /// \throw Error where a value is out of its range; the strength's is the method's, see MethodRow
    void check() const;
};

/// What storing does to positions.
using Rounding = std::function<Points(const Points&)>;

/// Positions of one round of embedding, and how they came about.
struct Proposal {
    Points points;            ///< as placed, not yet rounded
    int guarded_vertices = 0; ///< vertices that took another point than their best, so that no face folds
    std::optional<SolverSummary> solver;
    std::optional<MoveCounts> moves;
};

/// What a method made of a cover.
struct Marking {
    Proposal kept; ///< the round that reads best
    int rounds = 0;
    int samples_min = 0; ///< vertices in the poorest carrier
    /// Carriers that this mesh has vertices for, with this method, statistic and trim, up to 1024. Whether so many read
    /// back, only embedding tells.
    int capacity = 0;
    std::vector<std::string> warnings;
};

/// Thrown where a mesh cannot carry so many carriers with this method and key.
class DoesNotFit : public Error {
public:
    explicit DoesNotFit(const std::string& cause, int roomy = 0) : Error(cause), roomy_(roomy) {}

    /// Carriers that would all hold vertices; 0 where that is not known.
    [[nodiscard]] int roomy() const { return roomy_; }

private:
    int roomy_;
};

} // namespace vcg_ext
