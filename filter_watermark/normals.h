// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "host.h"

#include <array>
#include <vector>

/// The memory that new normals need. What has it before the mesh is changed, or a report written, cannot fail afterwards.
struct NormalShares {
    static constexpr int faces = 1 << 15; ///< at a time

    struct Corner {
        CVertexO* vertex = nullptr;
        Point3m share;
    };

    explicit NormalShares(std::size_t vertices) : corners(faces), begun(vertices) {}

    std::vector<std::array<Corner, 3>> corners;
    std::vector<char> begun; ///< per vertex whether its sum has a first term
};

/// What MeshLab's own update does on one core, with the same sums in the same order, on all of them.
/// \param shares of as many vertices as the mesh has, deleted ones too
void update_box_and_normals(CMeshO& mesh, NormalShares& shares);
