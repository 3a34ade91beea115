#include "closest.h"

#include "../error.h"
#include "../mesh.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vcg/complex/algorithms/closest.h>
#include <vcg/space/index/kdtree/kdtree_face.h>

namespace vcg_ext {

namespace {

bool has_width(const Points& points, const Triangle& t)
{
    double longest = 0;
    for (int k = 0; k < 3; ++k)
        longest = std::max(longest, (points[t[k]] - points[t[(k + 1) % 3]]).squaredNorm());
    return longest > 0 && scaled_normal(points, t).norm() > 1e-12 * longest;
}

} // namespace

struct ClosestSearch::Tree {
    Mesh mesh;
    std::vector<int> face; ///< per face of `mesh`: its number in the surface
    std::optional<vcg::KdTreeFace<Mesh>> tree;
};

ClosestSearch::ClosestSearch(const Surface& surface) : tree_(std::make_unique<Tree>())
{
    Surface wide;
    wide.points = surface.points;
    for (std::size_t f = 0; f < surface.triangles.size(); ++f)
        if (has_width(surface.points, surface.triangles[f])) {
            wide.triangles.push_back(surface.triangles[f]);
            tree_->face.push_back(static_cast<int>(f));
        }
    if (wide.triangles.empty())
        throw Error("No face of the mesh has an area, so there is no surface to measure distances to. Check its "
                    "coordinates, or reconstruct the surface.");
    to_mesh(wide, tree_->mesh);

    // vcglib's own depth of 64 takes all memory where more faces than a leaf holds meet in one point.
    constexpr int leaf = 8;
    const double leaves = static_cast<double>(wide.triangles.size()) / leaf;
    const int depth = std::clamp(static_cast<int>(std::ceil(std::log2(leaves))) + 4, 1, 22);
    tree_->tree.emplace(tree_->mesh, leaf, depth);
}

ClosestSearch::~ClosestSearch() = default;

ClosestPoint ClosestSearch::operator()(const Point& p, double reach) const
{
    vcg::face::PointDistanceBaseFunctor<double> distance_to_face;
    vcg::tri::EmptyTMark<Mesh> unmarked;
    vcg::Point3d nearest;
    double distance = 0;
    const Face* face = tree_->tree->GetClosest(distance_to_face, unmarked, vcg::Point3d(p.x(), p.y(), p.z()), reach,
                                               distance, nearest);
    if (!face)
        return {};
    return {distance, Point(nearest[0], nearest[1], nearest[2]), tree_->face[vcg::tri::Index(tree_->mesh, face)]};
}

} // namespace vcg_ext
