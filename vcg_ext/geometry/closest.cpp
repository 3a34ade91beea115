// SPDX-License-Identifier: GPL-3.0-or-later
#include "closest.h"

#include "../base/error.h"
#include "../base/mesh.h"

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

/// vcglib's distance to a face; to the longest edge of one that is marked as a needle by a zero normal. (vcglib takes
/// the diagonal of such a face's box.)
class DistanceToFace {
public:
    using QueryType = vcg::Point3d;

    bool operator()(const Face& face, const vcg::Point3d& p, double& least, vcg::Point3d& nearest) const
    {
        if (face.cN() != vcg::Point3d(0, 0, 0))
            return vcg::face::PointDistanceBase(face, p, least, nearest);
        vcg::Point3d place;
        double distance = 0;
        vcg::SegmentPointDistance(longest_edge(face), p, place, distance);
        distance *= 1 + 1e-9; // a proper face along this edge goes first
        if (distance > least)
            return false;
        least = distance;
        nearest = place;
        return true;
    }

private:
    static vcg::Segment3d longest_edge(const Face& face)
    {
        vcg::Segment3d longest(face.cP(0), face.cP(1));
        for (int k = 1; k < 3; ++k)
            if (const vcg::Segment3d edge(face.cP(k), face.cP((k + 1) % 3)); edge.Length() > longest.Length())
                longest = edge;
        return longest;
    }
};

} // namespace

struct ClosestSearch::Tree {
    Mesh mesh;
    std::optional<vcg::KdTreeFace<Mesh>> tree;
};

ClosestSearch::ClosestSearch(const Surface& surface) : tree_(std::make_unique<Tree>())
{
    const auto wide = [&](const Triangle& t) { return has_width(surface.points, t); };
    if (std::none_of(surface.triangles.begin(), surface.triangles.end(), wide))
        throw Error("No face of the mesh has an area, so there is no surface to measure distances to. Check its "
                    "coordinates, or reconstruct the surface.");
    to_mesh(surface, tree_->mesh);
    for (std::size_t f = 0; f < surface.triangles.size(); ++f)
        if (!wide(surface.triangles[f]))
            tree_->mesh.face[f].N() = {0, 0, 0};

    // vcglib's own depth of 64 takes all memory where more faces than a leaf holds meet in one point.
    constexpr int leaf = 16;
    const double leaves = static_cast<double>(surface.triangles.size()) / leaf;
    const int depth = std::clamp(static_cast<int>(std::ceil(std::log2(leaves))) + 4, 1, 22);
    tree_->tree.emplace(tree_->mesh, leaf, depth);
}

ClosestSearch::~ClosestSearch() = default;

ClosestPoint ClosestSearch::operator()(const Point& p, double reach) const
{
    DistanceToFace distance_to_face;
    vcg::tri::EmptyTMark<Mesh> unmarked;
    vcg::Point3d nearest;
    double distance = 0;
    const Face* face = tree_->tree->GetClosest(distance_to_face, unmarked, to_vcg(p), reach, distance, nearest);
    if (!face)
        return {};
    return {distance, from_vcg(nearest), static_cast<int>(vcg::tri::Index(tree_->mesh, face))};
}

} // namespace vcg_ext
