// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/vectorized.h"
#include "wave_columns.h"

namespace vcg_ext {

/// The small triangles of a large mesh by the cell of space that holds their centroid, so that the number of waves costs
/// by the cell: the sum of (q . n) exp(i q . x) about a cell's centre is a polynomial of q up to the fifth degree. Of
/// |q . x| it takes at most .7 and a triangle, usually .3: the rest is below 1e-4 of a cell.
class TriangleCells {
public:
    /// No cells where the mesh is small, or so large against the waves that they would be too many.
    /// \param q, points, triangles must outlive this   \param largest of all |q|
    TriangleCells(const WaveColumns& q, const Points& points, const std::vector<Triangle>& triangles, double largest);

    /// Whether a cell holds this triangle: the others are too large for that.
    [[nodiscard]] bool holds(int triangle) const { return cell_[triangle] >= 0; }

    /// The number of cells that hold any.
    [[nodiscard]] int count() const { return static_cast<int>(centres_.size()); }

    /// Adds what add_triangle() would for each triangle of a cell.
    void add(int cell, WaveSums& sums) const;

private:
    void number_cells(const Eigen::AlignedBox3d& box, double edge, const Eigen::Array3d& span);

    const WaveColumns& q_;
    const Points& points_;
    const std::vector<Triangle>& triangles_;
    double largest_;
    std::vector<StoredLanes> powers_; ///< products of the waves' components
    std::vector<int> cell_;           ///< per triangle its place in the grid of cells, or -1
    Points centres_;                  ///< of the cells that hold any
    std::vector<int> first_;          ///< those of cell i are `triangle_[first_[i]]` on, in ascending order
    std::vector<int> triangle_;
};

} // namespace vcg_ext
