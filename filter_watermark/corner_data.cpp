// SPDX-License-Identifier: GPL-3.0-or-later
#include "corner_data.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace {

/// Calls `visit(value)` for all that a corner shows of a layer's kinds of data.
template <class Visit>
void visit_corner(const MeshModel& layer, CFaceO& face, int corner, const Visit& visit)
{
    CVertexO& vertex = *face.V(corner);
    if (layer.hasDataMask(MeshModel::MM_VERTCOLOR))
        for (int i = 0; i < 4; ++i)
            visit(vertex.C()[i]);
    if (layer.hasDataMask(MeshModel::MM_VERTQUALITY))
        visit(vertex.Q());
    const auto visit_texture = [&visit](auto& place) {
        visit(place.U());
        visit(place.V());
        visit(place.N());
    };
    if (layer.hasDataMask(MeshModel::MM_VERTTEXCOORD))
        visit_texture(vertex.T());
    if (layer.hasDataMask(MeshModel::MM_WEDGTEXCOORD))
        visit_texture(face.WT(corner));
}

/// The same for all corners of faces that are not deleted, in order.
template <class Visit>
void visit_corners(MeshModel& layer, const Visit& visit)
{
    for (CFaceO& face : layer.cm.face)
        for (int corner = 0; corner < 3 && !face.IsD(); ++corner)
            visit_corner(layer, face, corner, visit);
}

} // namespace

vcg_ext::CornerValues read_corner_values(MeshModel& layer)
{
    vcg_ext::CornerValues values;
    if (!layer.hasDataMask(MeshModel::MM_VERTCOLOR) && !layer.hasDataMask(MeshModel::MM_VERTQUALITY) &&
        !has_texture(layer))
        return values;
    visit_corners(layer, [&values](const auto& value) { values.values.push_back(double(value)); });
    values.channels = int(values.values.size() / std::size_t(3 * std::max(1, layer.cm.fn)));
    return values;
}

void write_corner_values(MeshModel& layer, const vcg_ext::CornerValues& values)
{
    auto next = values.values.begin();
    visit_corners(layer, [&next](auto& value) {
        using Value = std::decay_t<decltype(value)>;
        value = Value(std::is_integral_v<Value> ? std::round(*next) : *next);
        ++next;
    });
}

bool has_texture(const MeshModel& layer)
{
    return layer.hasDataMask(MeshModel::MM_VERTTEXCOORD) || layer.hasDataMask(MeshModel::MM_WEDGTEXCOORD);
}
