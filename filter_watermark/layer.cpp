// SPDX-License-Identifier: GPL-3.0-or-later
#include "layer.h"

#include <vcg_ext/base/error.h>
#include <vcg_ext/base/parallel.h>

#include <Eigen/SVD>
#include <algorithm>

MeshModel& current_layer_or_error(MeshDocument& document)
{
    if (MeshModel* layer = document.mm())
        return *layer;
    throw vcg_ext::Error("There is no mesh. Open one first.");
}

std::string about_other_layers(MeshDocument& document, const std::string& what)
{
    const MeshModel& layer = *document.mm();
    const int others = visible_layers(document) - int(layer.isVisible());
    if (others == 0)
        return {};
    return "Only layer '" + layer.label().toStdString() + "' of " + std::to_string(1 + others) + " " + what +
           ". Where they are parts of one body, apply 'Flatten Visible Layers' first.";
}

const MeshModel& other_layer(const RichParameterList& values, const QString& parameter, MeshDocument& document)
{
    const MeshModel* layer = layer_value(values, parameter, document);
    const std::string name = parameter.toStdString();
    if (!layer)
        throw vcg_ext::Error("There is no layer for " + name + ". Open that mesh too, and choose its layer.");
    if (layer == document.mm())
        throw vcg_ext::Error(name + " is the current layer itself. Open the other mesh too, and choose its layer.");
    return *layer;
}

namespace {

constexpr double rounding = 1e-5; ///< of a similarity that went through products of floats; no mark notices

Eigen::Matrix4d matrix_of(const MeshModel& layer)
{
    Eigen::Matrix4d matrix;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            matrix(i, j) = double(layer.cm.Tr.ElementAt(i, j));
    return matrix;
}

} // namespace

bool is_stretched(const MeshModel& layer)
{
    const Eigen::Matrix4d matrix = matrix_of(layer);
    const bool affine = matrix.allFinite() && matrix.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1));
    const Eigen::Matrix3d linear = affine ? matrix.topLeftCorner<3, 3>().eval() : Eigen::Matrix3d::Zero().eval();
    const Eigen::Vector3d scales = Eigen::JacobiSVD<Eigen::Matrix3d>(linear).singularValues();
    if (scales[2] <= 1e-6 * scales[0])
        throw vcg_ext::Error("The layer's matrix is singular: it leaves no body to look at. Set another one, or apply "
                             "'Matrix: Reset Current Matrix' (in Python: set_matrix_identity).");
    return scales[0] > (1 + rounding) * scales[2];
}

vcg_ext::Surface read_surface(const MeshModel& layer)
{
    return read_surface(layer, is_stretched(layer));
}

namespace {

/// The elements that are not deleted, in order.
class Present {
public:
    template <class Elements>
    Present(const Elements& elements, int count) : count_(count)
    {
        if (count == int(elements.size()))
            return;
        numbers_ = vcg_ext::indices_where(int(elements.size()), [&](int i) { return !elements[i].IsD(); });
        count_ = int(numbers_.size());
    }

    int count() const { return count_; }
    int operator[](int i) const { return numbers_.empty() ? i : numbers_[i]; }

private:
    int count_;
    std::vector<int> numbers_; ///< empty where all are there
};

} // namespace

vcg_ext::Surface read_surface(const MeshModel& layer, bool with_matrix)
{
    const CMeshO& mesh = layer.cm;
    const Present vertices(mesh.vert, mesh.vn);
    const Present faces(mesh.face, mesh.fn);
    const bool all = vertices.count() == int(mesh.vert.size());
    vcg_ext::Surface surface;
    surface.points.resize(vertices.count());
    surface.triangles.resize(faces.count());
    std::vector<int> number(all ? 0 : mesh.vert.size(), -1);
    vcg_ext::for_each_index(vertices.count(), [&](int i) {
        const auto& p = mesh.vert[vertices[i]].cP();
        surface.points[i] = vcg_ext::Point(p[0], p[1], p[2]);
        if (!all)
            number[vertices[i]] = i;
    });
    vcg_ext::for_each_index(faces.count(), [&](int i) {
        for (int corner = 0; corner < 3; ++corner) {
            const int v = int(mesh.face[faces[i]].cV(corner) - mesh.vert.data());
            surface.triangles[i][corner] = all ? v : number[v];
        }
    });
    if (with_matrix) {
        const Eigen::Affine3d matrix(matrix_of(layer));
        for (vcg_ext::Point& point : surface.points)
            point = matrix * point;
    }
    return surface;
}

namespace {

/// Calls `write(vertex, value)` for the vertices that are not deleted and the values, in order.
template <class Values, class Write>
void for_each_vertex(MeshModel& layer, const Values& values, const Write& write)
{
    auto& vertices = layer.cm.vert;
    if (values.size() == vertices.size()) {
        vcg_ext::for_each_index(int(vertices.size()), [&](int v) { write(vertices[v], values[v]); });
        return;
    }
    auto value = values.begin();
    for (CVertexO& vertex : vertices)
        if (!vertex.IsD())
            write(vertex, *value++);
}

/// Points that read_surface() gave: a matrix that stretches is in them.
void put_points(MeshModel& layer, const vcg_ext::Points& points)
{
    if (is_stretched(layer))
        layer.cm.Tr.SetIdentity();
    for_each_vertex(layer, points, [](CVertexO& vertex, const vcg_ext::Point& point) {
        vertex.P() = Point3m(Scalarm(point.x()), Scalarm(point.y()), Scalarm(point.z()));
    });
}

} // namespace

void write_positions(MeshModel& layer, const vcg_ext::Points& points, NormalShares& shares)
{
    put_points(layer, points);
    update_box_and_normals(layer.cm, shares);
}

void write_classes(MeshModel& layer, const std::vector<int>& class_of_vertex)
{
    layer.updateDataMask(MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR);
    const int classes = 1 + *std::max_element(class_of_vertex.begin(), class_of_vertex.end());
    for_each_vertex(layer, class_of_vertex, [classes](CVertexO& vertex, int number) {
        vertex.Q() = number;
        vertex.C() = number < 0 ? vcg::Color4b(vcg::Color4b::LightGray) : vcg::Color4b::Scatter(classes, number);
    });
}

void write_distances(MeshModel& layer, const std::vector<double>& distance_of_vertex, double most)
{
    const bool colored = layer.hasDataMask(MeshModel::MM_VERTCOLOR);
    layer.updateDataMask(MeshModel::MM_VERTQUALITY);
    for_each_vertex(layer, distance_of_vertex, [](CVertexO& vertex, double distance) { vertex.Q() = distance; });
    if (colored)
        return;
    layer.updateDataMask(MeshModel::MM_VERTCOLOR);
    vcg::tri::UpdateColor<CMeshO>::PerVertexQualityRamp(layer.cm, 0, Scalarm(most));
}

MeshModel& add_copy(MeshDocument& document, const MeshModel& layer, const QString& label)
{
    const bool stretched = is_stretched(layer);
    const vcg_ext::Surface surface = read_surface(layer, stretched);
    MeshModel& copy = *document.addNewMesh(QString(), label, false);
    write_surface(copy, surface);
    if (!stretched)
        copy.cm.Tr = layer.cm.Tr;
    return copy;
}

void write_surface(MeshModel& layer, const vcg_ext::Surface& surface)
{
    CMeshO& mesh = layer.cm;
    NormalShares shares(surface.points.size());
    CMeshO room; // where the memory is missing, it is missed here, while the layer is whole
    vcg::tri::Allocator<CMeshO>::AddVertices(room, surface.points.size());
    vcg::tri::Allocator<CMeshO>::AddFaces(room, surface.triangles.size());
    room.Clear();
    layer.clearDataMask(MeshModel::MM_FACEFACETOPO | MeshModel::MM_VERTFACETOPO | MeshModel::MM_WEDGTEXCOORD |
                        MeshModel::MM_VERTTEXCOORD | MeshModel::MM_FACECOLOR | MeshModel::MM_FACEQUALITY |
                        MeshModel::MM_POLYGONAL);
    mesh.Clear();
    vcg::tri::Allocator<CMeshO>::AddVertices(mesh, surface.points.size());
    vcg::tri::Allocator<CMeshO>::AddFaces(mesh, surface.triangles.size());
    put_points(layer, surface.points);
    for (std::size_t f = 0; f < surface.triangles.size(); ++f)
        for (int corner = 0; corner < 3; ++corner)
            mesh.face[f].V(corner) = &mesh.vert[surface.triangles[f][corner]];
    update_box_and_normals(mesh, shares);
}
