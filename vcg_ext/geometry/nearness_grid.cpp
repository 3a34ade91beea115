// SPDX-License-Identifier: GPL-3.0-or-later
#include "nearness_grid.h"

#include "../base/parallel.h"

#include <algorithm>
#include <cmath>

namespace vcg_ext {

NearnessGrid::NearnessGrid(const FootSearch& surface, double reach)
{
    const Eigen::AlignedBox3d box = bounding_box(surface.surface());
    cell_ = (box.sizes().maxCoeff() + 2 * reach) / cells;
    corner_ = box.min() - Point::Constant(reach);
    std::size_t all = 1;
    for (int k = 0; k < 3; ++k) {
        count_[k] = static_cast<int>(std::ceil((box.sizes()[k] + 2 * reach) / cell_)) + 1;
        all *= count_[k];
    }
    nearness_.resize(all);
    for_chunks(static_cast<int>(all), 1024, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            const int x = i % count_[0];
            const int y = i / count_[0] % count_[1];
            const int z = i / (count_[0] * count_[1]);
            const Point middle = corner_ + cell_ * Point(x + 0.5, y + 0.5, z + 0.5);
            const Foot foot = surface(middle, reach);
            nearness_[i] = foot.face < 0 ? 0 : static_cast<float>(std::max(0.0, 1 - foot.distance / reach));
        }
    });
}

double NearnessGrid::operator()(const Point& p) const
{
    std::array<int, 3> at;
    for (int k = 0; k < 3; ++k) {
        const double place = (p[k] - corner_[k]) / cell_;
        if (!(place >= 0 && place < count_[k]))
            return 0;
        at[k] = static_cast<int>(place);
    }
    return nearness_[(static_cast<std::size_t>(at[2]) * count_[1] + at[1]) * count_[0] + at[0]];
}

} // namespace vcg_ext
