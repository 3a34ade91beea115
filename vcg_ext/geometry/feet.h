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

/// What a face's corners have, at a place on it. \param of_vertices of the surface   \param weights of the corners
template <class Value>
[[nodiscard]] Value at_foot(const std::vector<Value>& of_vertices, const Triangle& t, const Point& weights)
{
    return weights[0] * of_vertices[t[0]] + weights[1] * of_vertices[t[1]] + weights[2] * of_vertices[t[2]];
}

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
