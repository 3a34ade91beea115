// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "closest.h"

namespace vcg_ext {

/// Where a point of another surface stands on this one.
struct Foot {
    int face = -1;                 ///< none within reach
    Point weights = Point::Zero(); ///< of the face's corners
    Point point = Point::Zero();
    double distance = 0;
    bool on_rim = false; ///< at the surface's border: what is beyond it is missing here, and not displaced
};

/// A surface to whose faces points of another are brought. Built once; may be asked by many threads at once.
class FootSearch {
public:
    /// \throw Error where no face has an area
    explicit FootSearch(Surface surface);

    [[nodiscard]] Foot operator()(const Point& p, double reach) const;

    [[nodiscard]] const Surface& surface() const { return surface_; }
    /// Of faces, unit; zero where a face has no area.
    [[nodiscard]] const Points& normals() const { return normals_; }

private:
    Surface surface_;
    Points normals_;
    std::vector<unsigned char> open_; ///< per face: bit k where the edge opposite corner k is on the border
    std::vector<char> rim_;           ///< per vertex
    ClosestSearch nearest_;
};

} // namespace vcg_ext
