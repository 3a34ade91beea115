// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "host.h"
#include "normals.h"

#include <vcg_ext/base/surface.h>

/// The current layer. \throw vcg_ext::Error where the document has none
MeshModel& current_layer_or_error(MeshDocument& document);

/// Where other layers are seen beside the current one, which of them this is and what became of it alone ("carries the
/// mark"); else empty.
std::string about_other_layers(MeshDocument& document, const std::string& what);

/// The layer that a parameter names, to be held against the current one.
/// \throw vcg_ext::Error where it is none, or the current one
const MeshModel& other_layer(const RichParameterList& values, const QString& parameter, MeshDocument& document);

/// Whether the layer's matrix is no similarity: what is seen is then of another shape than what its points make up.
/// \throw vcg_ext::Error where it is singular
bool is_stretched(const MeshModel& layer);

/// What to tell of such a layer, where it is read only, and where it is written.
constexpr const char* stretched_as_read =
    "The layer's matrix stretches it. It was looked at as it is seen; a file that "
    "MeshLab saves has the points without the matrix.";
constexpr const char* stretched_as_written =
    "The layer's matrix stretches it. It is applied to the points now, as 'Matrix: Freeze Current Matrix' does, because "
    "MeshLab saves points without it: what is seen and what is saved are one shape.";

/// The layer's vertices and faces that are not deleted, in order: as they are seen, where the matrix stretches; else
/// without it, since neither a mark nor an attack minds a similarity.
vcg_ext::Surface read_surface(const MeshModel& layer);

/// The same with its matrix, or without.
vcg_ext::Surface read_surface(const MeshModel& layer, bool with_matrix);

/// Gives the vertices that are not deleted the positions that read_surface() gave, changed, in order. All else stays;
/// normals and box follow. A matrix that stretches becomes the identity: the positions have it in them, and files are
/// written without a matrix, so that what is seen, saved and read is one body.
/// \param shares of as many vertices as the layer has, deleted ones too
void write_positions(MeshModel& layer, const vcg_ext::Points& points, NormalShares& shares);

/// Gives the vertices that are not deleted a quality each, in order, and colours from it: a colour of its own for each
/// whole number, grey for -1.
void write_classes(MeshModel& layer, const std::vector<int>& class_of_vertex);

/// Gives the vertices that are not deleted a quality each, in order, and colours from red for 0 to blue for `most` and
/// more; a layer that has colours keeps them.
void write_distances(MeshModel& layer, const std::vector<double>& distance_of_vertex, double most);

/// A copy of the layer's shape, in the same place, in a new layer, which does not become the current one.
MeshModel& add_copy(MeshDocument& document, const MeshModel& layer, const QString& label);

/// Puts another mesh into the layer, whose name stays, and its matrix as with write_positions().
void write_surface(MeshModel& layer, const vcg_ext::Surface& surface);
