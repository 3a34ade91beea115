// SPDX-License-Identifier: GPL-3.0-or-later
#include "layer.h"

#include <vcg_ext/base/error.h>
#include <vcg_ext/base/parallel.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <type_traits>

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

/// Of the elements that are not deleted, in order.
template <class Elements>
std::vector<int> indices_of_present(const Elements& elements)
{
    return vcg_ext::indices_where(int(elements.size()), [&elements](int i) { return !elements[i].IsD(); });
}

} // namespace

vcg_ext::Surface read_surface(const MeshModel& layer, bool with_matrix)
{
    const CMeshO& mesh = layer.cm;
    const std::vector<int> vertices = indices_of_present(mesh.vert);
    const std::vector<int> faces = indices_of_present(mesh.face);
    vcg_ext::Surface surface;
    surface.points.resize(vertices.size());
    surface.triangles.resize(faces.size());
    std::vector<int> number(mesh.vert.size(), -1);
    vcg_ext::for_each_index(int(vertices.size()), [&](int i) {
        const auto& p = mesh.vert[vertices[i]].cP();
        surface.points[i] = vcg_ext::Point(p[0], p[1], p[2]);
        number[vertices[i]] = i;
    });
    vcg_ext::for_each_index(int(faces.size()), [&](int i) {
        for (int corner = 0; corner < 3; ++corner)
            surface.triangles[i][corner] = number[mesh.face[faces[i]].cV(corner) - mesh.vert.data()];
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

/// The corners' shares in their vertices' normals: the face's normal, weighted by the angle.
std::array<Point3m, 3> normals_by_angle(const CFaceO& face)
{
    const Point3m normal = vcg::TriangleNormal(face).Normalize();
    const auto edge = [&](int j) { return (face.cP((j + 1) % 3) - face.cP(j)).Normalize(); };
    const Point3m e0 = edge(0);
    const Point3m e1 = edge(1);
    const Point3m e2 = edge(2);
    return {normal * vcg::AngleN(e0, -e2), normal * vcg::AngleN(-e0, e1), normal * vcg::AngleN(-e1, e2)};
}

/// Calls `visit(i, corner, vertex)` for the corners of `count` faces from `first` on, in order at each vertex: the lower
/// half of the vertices on one core, the upper half on another.
template <class Visit>
void visit_corners_by_halves(CMeshO& mesh, std::size_t first, int count, const Visit& visit)
{
    const CVertexO* middle = mesh.vert.data() + mesh.vert.size() / 2;
    vcg_ext::for_chunks(2, 1, [&](int half, int) {
        for (int i = 0; i < count; ++i)
            if (CFaceO& face = mesh.face[first + i]; !face.IsD())
                for (int corner = 0; corner < 3; ++corner)
                    if ((face.V(corner) < middle) == (half == 0))
                        visit(i, corner, *face.V(corner));
    });
}

/// What MeshLab's own update does on one core, with the same sums in the same order, on all of them.
/// \param shares of `faces_at_a_time`
void update_box_and_normals(CMeshO& mesh, NormalShares& shares)
{
    mesh.bbox = vcg_ext::ordered_fold(
        int(mesh.vert.size()), Box3m(),
        [&mesh](Box3m& box, int v) {
            if (!mesh.vert[v].IsD())
                box.Add(mesh.vert[v].cP());
        },
        [](Box3m& box, const Box3m& part) { box.Add(part); });
    const auto clear = [](int, int, CVertexO& vertex) { vertex.N() = Point3m(0, 0, 0); };
    visit_corners_by_halves(mesh, 0, int(mesh.face.size()), clear);
    for (std::size_t first = 0; first < mesh.face.size(); first += faces_at_a_time) {
        const int count = int(std::min<std::size_t>(faces_at_a_time, mesh.face.size() - first));
        vcg_ext::for_each_index(count, [&](int i) {
            CFaceO& face = mesh.face[first + i];
            if (face.IsD())
                return;
            face.N() = vcg::TriangleNormal(face).Normalize();
            shares[i] = normals_by_angle(face);
        });
        const auto add = [&](int i, int corner, CVertexO& vertex) { vertex.N() += shares[i][corner]; };
        visit_corners_by_halves(mesh, first, count, add);
    }
}

} // namespace

void write_positions(MeshModel& layer, const vcg_ext::Points& points, NormalShares& shares)
{
    put_points(layer, points);
    update_box_and_normals(layer.cm, shares);
}

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
    NormalShares shares(faces_at_a_time);
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
