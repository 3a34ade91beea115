// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "host.h"

#include <vcg_ext/geometry/corner_values.h>

/// The current layer. \throw vcg_ext::Error where the document has none
MeshModel& current_layer_or_error(MeshDocument& document);

/// The layer's vertices and faces that are not deleted, in order, without its matrix.
vcg_ext::Surface read_surface(const CMeshO& mesh);

/// Gives the vertices that are not deleted new positions, in order. All else stays; normals and box follow.
void write_positions(MeshModel& layer, const vcg_ext::Points& points);

/// What the layer's faces show that must not slide along with the vertices under it: colours and quality of vertices,
/// texture coordinates of vertices and wedges. No channels where it has none of these.
vcg_ext::CornerValues read_corner_values(MeshModel& layer);
void write_corner_values(MeshModel& layer, const vcg_ext::CornerValues& values);

/// Whether the layer has texture coordinates.
bool has_texture(const MeshModel& layer);

/// Gives the vertices that are not deleted a quality each, in order, and colours from it: a colour of its own for each
/// whole number, grey for -1.
void write_classes(MeshModel& layer, const std::vector<int>& class_of_vertex);

/// Gives the vertices that are not deleted a quality each, in order, and colours from red for 0 to blue for `most` and
/// more; a layer that has colours keeps them.
void write_distances(MeshModel& layer, const std::vector<double>& distance_of_vertex, double most);

/// A copy of the layer's shape, with its matrix, in a new layer, which does not become the current one.
MeshModel& add_copy(MeshDocument& document, const MeshModel& layer, const QString& label);

/// Puts another mesh into the layer, whose name and matrix stay.
void write_surface(MeshModel& layer, const vcg_ext::Surface& surface);
