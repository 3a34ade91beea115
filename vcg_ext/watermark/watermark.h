#pragma once
#include "../base/error.h"
#include "../base/progress.h"
#include "../base/surface.h"
#include "../carrier/statistic.h"
#include "../key/key.h"
#include "../payload/message.h"
#include "../placement/front.h"
#include "../placement/sphere.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vcg_ext {

/// How a vertex reaches its target; in the order in which users choose.
enum class Method {
    LM,       ///< vertex norms, sphere placement by Levenberg-Marquardt (thesis 5.5)
    QSP,      ///< vertex norms, quadric selective placement (thesis 5.4)
    Cho,      ///< vertex norms, radial placement (Cho et al.)
    Geodesic, ///< geodesic distances, front placement (thesis chapter 4)
    Spectral  ///< spectral coefficients of patches (thesis chapter 3)
};

constexpr int most_bits = 1024; ///< carriers at most

/// Which scalar the written file will hold. The blind self-check reads the coordinates as they will be stored.
enum class Storage { Float, Double };

[[nodiscard]] const char* name(Method method);

/// What embedding and detection must agree on, besides the key.
struct CarrierOptions {
    Method method = Method::LM;
    Statistic statistic = Statistic::Mean; ///< Spectral ignores it
    int bits = 64;                         ///< number of carriers, 1 to 1024
    double trim = -1; ///< eps of (5.2): part of the range cut off at both ends, 0 to 0.45; negative: drawn from the key
    /// Spectral: chapter 3 as the thesis prints it, for comparison. Patches of Algorithm 1 with their own Laplacians,
    /// exact eigenbases (up to 2,500 vertices a patch), the highest 70 %, (3.21), T = 2.25, no guard against folds.
    bool as_printed = false;
};

struct EmbedOptions : CarrierOptions {
    Bits message;                     ///< at most `bits` long; what is left is zero. `bits` 0 takes its length
    double strength = 0;              ///< alpha in (0, 0.5), for Spectral K > 1; 0 is the method's default, 0.1 and 15
    Storage storage = Storage::Float; ///< where it is Double, the mark is still checked after rounding to float
    int max_rounds = 10;              ///< rounds of correction before embedding gives up
    std::array<double, 3> sphere_weights = {0.49, 0.49, 0.02}; ///< k1, k2, k3 of (5.24), for Method::LM
    /// Jacobi sweeps of Method::LM: the first sees the neighbours on the cover, the next where the one before put them.
    /// More than one gains nothing: MRMS grows by 0 to 12 % (tests/benchmark/norm_methods).
    int sphere_sweeps = 1;
    FrontScheme front_scheme = FrontScheme::PredictCorrect; ///< for Method::Geodesic
};

struct EmbedReport {
    Method method{};
    Statistic statistic{};
    Bits bits;           ///< what was embedded, padded to the number of carriers
    double strength = 0; ///< as used
    double trim = 0;     ///< as used
    int carriers = 0;
    int samples_min = 0; ///< vertices in the poorest carrier
    /// Bits that this mesh has vertices for, with this method, statistic and trim, up to 1024: so many carriers would
    /// all hold some (Spectral: eight and more, if patches shrink alike). Whether that many read back with their
    /// message, only embedding them tells; where it does not, TooManyBits names a number that does.
    int capacity = 0;
    double detection_ratio = 0; ///< of the blind self-check: 1, or embed() throws
    int rounds = 0;
    int moved_vertices = 0;
    int guarded_vertices = 0; ///< vertices that took another point than their best, so that no face folds
    double max_displacement = 0;
    double mrms = 0;
    double mrms_relative = 0;              ///< over the bounding box's diagonal
    std::map<std::string, double> seconds; ///< by phase
    std::optional<SolverSummary> solver;   ///< Method::LM only
    std::optional<MoveCounts> moves;       ///< Method::Geodesic only
    std::vector<std::string> warnings;
};

struct DetectOptions : CarrierOptions {
    std::optional<Bits> expected; ///< the message to compare with, padded with zeros to `bits`
};

struct DetectReport {
    Method method{};
    Statistic statistic{};
    double trim = 0;
    Bits bits;
    std::vector<double>
        soft; ///< per bit: the statistic's distance from the threshold in standard errors, positive for 1
    std::vector<int> samples;              ///< per bit: vertices in its carrier
    std::optional<double> detection_ratio; ///< matching bits over all; with `expected` only
    std::optional<double> p_value; ///< binomial tail of at least that many matches by chance; times 4 for Spectral, the
                                   ///< best of 4 orientations
    std::optional<bool> present;   ///< p_value below 1e-6
    std::optional<int> smoothing_rounds; ///< of the surface before it was read; Method::Geodesic only
    std::map<std::string, double> seconds;
    std::vector<std::string> warnings;
    /// Spectral: whether axis 1 and axis 2 were read along (+) or against (-) the body's third moments, as "++" or
    /// "-+".
    std::string orientation;
    std::vector<int> carrier_of_vertex; ///< per vertex the number of the bit it carries, or -1
};

/// Thrown where a mesh cannot carry so many bits with this method and key.
class TooManyBits : public Error {
public:
    TooManyBits(const std::string& cause, int number);

    int carries; ///< a number of bits that was tried and read back, whatever their values; 0 where there is none
};

/// Hides a message in the positions of `surface`.
///
/// Ends with a blind detection on the coordinates as they will be stored; carriers that read wrong or weak get a
/// corrected target and another round.
///
/// \throw Error       on bad input: says what to do. `surface` is unchanged, as after the other two.
/// \throw TooManyBits where the message could not be read back, or the method finds no carriers; names a number of bits
///                    that could
/// \throw Cancelled   where `progress` returned false
EmbedReport embed(Surface& surface, const Key& key, const EmbedOptions& options, const Progress& progress = {});

/// Reads a message with the key alone. Same input, same answer: at any number of threads, on any machine.
///
/// \throw Error on input that cannot carry a mark: no faces, coordinates that are not finite, no range of values.
[[nodiscard]] DetectReport detect(const Surface& surface, const Key& key, const DetectOptions& options,
                                  const Progress& progress = {});

} // namespace vcg_ext
