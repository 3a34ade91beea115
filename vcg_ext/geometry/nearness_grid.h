// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "feet.h"

#include <array>

namespace vcg_ext {

/// How near to a surface a point is, roughly: distances at the middles of a grid's cells.
class NearnessGrid {
public:
    /// \param reach further away than this is all alike
    NearnessGrid(const FootSearch& surface, double reach);

    /// 1 on the surface, 0 from `reach` on.
    [[nodiscard]] double operator()(const Point& p) const;

private:
    static constexpr int cells = 48; ///< along the longest side
    double cell_ = 0;
    Point corner_ = Point::Zero();
    std::array<int, 3> count_{};
    std::vector<float> nearness_;
};

} // namespace vcg_ext
