// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/progress.h"
#include "feet.h"
#include "impression.h"

#include <Eigen/Geometry>

namespace vcg_ext {

/// How a surface lies in another that it was made from: cut, moved, scaled, mirrored, stretched, worn as it may be.
struct Registration {
    /// Whether it is a copy of the original at all: nearly all of it must lie near the original, most of it close.
    bool found = false;
    /// Takes it to the original: a similarity, or the mirror image of one.
    Eigen::Affine3d pose = Eigen::Affine3d::Identity();
    /// The same with twelve unknowns: stretched or sheared too.
    Eigen::Affine3d affine = Eigen::Affine3d::Identity();
    bool inside_out = false; ///< its faces look the other way, there
    double overlap = 0;      ///< part of its area that lies on the original
    /// Mean distance from the original under `affine`, the farthest twentieth left out, over the original's diagonal.
    double residual = 0;
    double stretched_less = 0; ///< the same under `pose`, over `residual`: above 1 where it was stretched
    const char* by = "";       ///< what found it: "identity", "volume", "surface", "features"

    [[nodiscard]] bool mirrored() const { return pose.linear().determinant() < 0; }
    /// Size of the surface over that of the original.
    [[nodiscard]] double scale() const;
};

/// Registers surfaces to one original. Never draws on anything but the two shapes; the work is bounded by counts of
/// trials and not by a clock, so the answer is the same everywhere.
class Registrar {
public:
    /// \param original must outlive it
    explicit Registrar(const FootSearch& original);
    /// \param like a registrar of the same original in another state: its size() and diagonal are taken
    Registrar(const FootSearch& original, const Registrar& like)
        : original_(original), likeness_(like.likeness_), size_(like.size_)
    {
    }
    /// Of an original of which no more is left than an impression: coarse poses by its scales, the last step by its
    /// points, brought to the faces of the copy.
    /// \param scales of the impression  \param impression must outlive it
    Registrar(const FootSearch& scales, const Impression& impression);

    /// Tries in this order, until one fits: the surface as it lies; principal axes of solid and of surface, each with
    /// all signs; the same against the original after 10 and 50 rounds of smoothing; local shapes (feature_poses.h).
    ///
    /// Each is refined by pairs of a sample and the plane of the original's face next to it, weighted as (1 + (r / 2
    /// s)^2)^-2 with s from the median: missing parts cost nothing, since samples are the surface's, and the planes are
    /// the original's, so noise does not bias their feet. First 7 unknowns, then 12. Of poses that fit about as well,
    /// as of symmetric bodies, the one that fits best after that is taken.
    ///
    /// \throw Error     where the surface has no area
    /// \throw Cancelled where `progress` returned false
    [[nodiscard]] Registration operator()(const Surface& surface, const Progress& progress = {}) const;

    /// Refines a pose that is near already.
    void refine(const Surface& surface, Registration& registration) const;

    /// The same by fewer samples and in fewer steps, with twelve unknowns only: to compare originals that differ little.
    void follow(const Surface& surface, Registration& registration) const;

    [[nodiscard]] const FootSearch& original() const { return original_; }
    /// Radius of the ball of the original's volume, or of its area where it bounds nothing.
    [[nodiscard]] double size() const { return size_; }

private:
    void settle(const Surface& surface, Registration& registration) const;

    const FootSearch& original_;
    const Impression* impression_ = nullptr;
    Likeness likeness_;
    double size_ = 0;
};

} // namespace vcg_ext
