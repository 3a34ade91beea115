// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "features.h"

#include <optional>

namespace vcg_ext {

/// A frame and a length, by which two surfaces can be laid on each other; a length of 0 where there is no such.
struct Stand {
    Point centre = Point::Zero();
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    double length = 0;
};

/// Centre, axes and square root of the area.
[[nodiscard]] Stand surface_stand(const Surface& surface);

/// Centre, axes and ball radius of the solid; a length of 0 where there is none.
[[nodiscard]] Stand solid_stand(const Surface& surface);

/// What an original is known by, before a look at its faces.
struct Likeness {
    Stand solid;
    Stand surface;
    double diagonal = 0;              ///< of the bounding box
    double edge = 0;                  ///< mean length; 0 where it is not known
    std::optional<Features> features; ///< see own_features(); they take a while, so only where they are there already

    /// Radius of the ball of its volume, or of its area where it bounds nothing.
    [[nodiscard]] double size() const;
};

[[nodiscard]] Likeness likeness_of(const Surface& surface);

/// Features of the original itself; their only size is its diagonal.
[[nodiscard]] Features own_features(const Surface& original, int count = 250);

/// The same at given points.
[[nodiscard]] Features own_features(const Surface& original, const Points& points);

/// Those of a surface that may be a copy. \param sizes see features_of()
[[nodiscard]] Features features_to_match(const Surface& surface, const std::vector<double>& sizes);

} // namespace vcg_ext
