#include "layer.h"

#include <vcg_ext/error.h>

#include <algorithm>

MeshModel& current_layer_or_error(MeshDocument& document)
{
    if (MeshModel* layer = document.mm())
        return *layer;
    throw vcg_ext::Error("There is no mesh. Open one first.");
}

vcg_ext::Surface read_surface(const CMeshO& mesh)
{
    vcg_ext::Surface surface;
    std::vector<int> index(mesh.vert.size(), -1);
    surface.points.reserve(mesh.vn);
    for (std::size_t i = 0; i < mesh.vert.size(); ++i) {
        if (mesh.vert[i].IsD())
            continue;
        index[i] = int(surface.points.size());
        const auto& p = mesh.vert[i].cP();
        surface.points.emplace_back(p[0], p[1], p[2]);
    }
    surface.triangles.reserve(mesh.fn);
    for (const CFaceO& face : mesh.face) {
        if (face.IsD())
            continue;
        const auto corner = [&](int j) { return index[face.cV(j) - mesh.vert.data()]; };
        surface.triangles.push_back({corner(0), corner(1), corner(2)});
    }
    return surface;
}

void write_positions(MeshModel& layer, const vcg_ext::Points& points)
{
    auto point = points.begin();
    for (CVertexO& vertex : layer.cm.vert) {
        if (!vertex.IsD()) {
            vertex.P() = Point3m(Scalarm(point->x()), Scalarm(point->y()), Scalarm(point->z()));
            ++point;
        }
    }
    update_box_and_normals(layer);
}

void write_classes(MeshModel& layer, const std::vector<int>& class_of_vertex)
{
    layer.updateDataMask(MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR);
    const int classes = 1 + *std::max_element(class_of_vertex.begin(), class_of_vertex.end());
    auto number = class_of_vertex.begin();
    for (CVertexO& vertex : layer.cm.vert) {
        if (!vertex.IsD()) {
            vertex.Q() = *number;
            vertex.C() = *number < 0 ? vcg::Color4b(vcg::Color4b::LightGray) : vcg::Color4b::Scatter(classes, *number);
            ++number;
        }
    }
}
