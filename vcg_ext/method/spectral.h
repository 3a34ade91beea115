#pragma once
#include "../base/progress.h"
#include "../carrier/patches.h"
#include "../placement/cover.h"
#include "../placement/patch_shape.h"
#include "../watermark/watermark.h"

#include <functional>

namespace vcg_ext {

/// What both sides agree on before they see a mesh.
struct PatchPlan {
    std::vector<int> order;  ///< keyed: patch order[i] carries bit i; those after the last bit are spare
    double trim = 0;         ///< alpha_trim of (3.6), at both ends of axis 1
    bool as_printed = false; ///< chapter 3 as the thesis prints it, see CarrierOptions
};

/// \param trim negative: drawn from the key
[[nodiscard]] PatchPlan patch_plan(const Key& key, int bits, double trim, bool as_printed);

/// What the detector sees of a surface.
struct PatchReading {
    Frame frame;
    Patches patches;
    std::vector<std::vector<int>> vertices; ///< per patch
    Points band;                            ///< per vertex its high band
    std::vector<PatchShape> shapes;         ///< per patch
    double threshold = 0;                   ///< of the logarithm of the ratio

    /// How far the patch's log ratio is above the threshold in standard errors (2 / sqrt(n), as for Gaussian
    /// coefficients).
    [[nodiscard]] double soft(int patch) const;
};

/// \param like a frame whose axes' signs are taken, instead of those by third moments
[[nodiscard]] PatchReading read_patches(const Surface& surface, const PatchPlan& plan, const Frame* like = nullptr);

/// The patch that carries bit i where the axes point as `flips` says, then the spare ones; -1 where the surface has no
/// such.
[[nodiscard]] std::vector<int> carrying_patches(const PatchReading& reading, const PatchPlan& plan, AxisFlips flips);

/// Which way round the body lies, without knowledge of the message. Third moments decide, as in the thesis; along an
/// axis on which the body is mirror-symmetric, and so has none, the spare patches do: they carry 0, 1, 0, 1, ...
[[nodiscard]] AxisFlips blind_orientation(const PatchReading& reading, const PatchPlan& plan, int bits);

/// The closed loop: round as stored, align and read as the detector will, reshape the patches that lack margin. Returns
/// the best round's positions, judged by its worst patch.
///
/// \param cover welded   \param mask XOR-ed into the message's bits, which are those of `result`
/// \param round what storing does to positions
/// \throw Error where patches are too small or too few
[[nodiscard]] Points embed_spectral(const Cover& cover, const PatchPlan& plan, const Bits& mask,
                                    const EmbedOptions& options, const std::function<Points(const Points&)>& round,
                                    EmbedReport& result, const Progress& progress);

/// Reads bits, soft values, samples and `carrier_of_vertex` (per vertex of `surface`) in the orientation that matches
/// the expected message best, or without one in blind_orientation(). Returns how many orientations it chose from by the
/// message.
int detect_spectral(const Surface& surface, const PatchPlan& plan, const Bits& mask, const DetectOptions& options,
                    DetectReport& result);

} // namespace vcg_ext
