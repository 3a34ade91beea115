// SPDX-License-Identifier: GPL-3.0-or-later
#include "residual_field.h"

#include <algorithm>
#include <cmath>

namespace vcg_ext {

void put_affine(Rows::RowXpr row, const Point& place, const Point& normal)
{
    row.head<3>() = normal;
    for (int a = 0; a < 3; ++a)
        row.segment<3>(3 + 3 * a) = place[a] * normal;
}

void to_unit_rms(Rows& columns)
{
    for (Eigen::Index c = 0; c < columns.cols(); ++c) {
        const double rms = std::sqrt(columns.col(c).squaredNorm() / static_cast<double>(columns.rows()));
        columns.col(c) /= std::max(rms, 1e-12);
    }
}

} // namespace vcg_ext
