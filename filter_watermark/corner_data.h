// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "host.h"

#include <vcg_ext/geometry/corner_values.h>

/// What the layer's faces show that must not slide along with the vertices under it: colours and quality of vertices,
/// texture coordinates of vertices and wedges. No channels where it has none of these.
vcg_ext::CornerValues read_corner_values(MeshModel& layer);
void write_corner_values(MeshModel& layer, const vcg_ext::CornerValues& values);

/// Whether the layer has texture coordinates.
bool has_texture(const MeshModel& layer);
