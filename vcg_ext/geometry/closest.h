// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"

#include <limits>
#include <memory>

namespace vcg_ext {

/// The place on a surface that is nearest to some point.
struct ClosestPoint {
    double distance = std::numeric_limits<double>::infinity(); ///< infinite where nothing lies within the given reach
    Point point = Point::Zero();
    int face = -1; ///< of the surface that the search was made of
};

/// Finds nearest places on a surface, by vcglib's tree of faces. Built once; may be asked by many threads at once.
///
/// Distances are exact up to some 1e-7 of themselves (the tree rounds its bounds to float). Faces thinner than 1e-12 of
/// their longest edge count as that edge.
class ClosestSearch {
public:
    /// \throw Error where no face has an area
    explicit ClosestSearch(const Surface& surface);
    ~ClosestSearch();

    /// \param reach places further away than this are not looked for; a tight one saves time
    [[nodiscard]] ClosestPoint operator()(const Point& p, double reach = std::numeric_limits<double>::max()) const;

private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

} // namespace vcg_ext
