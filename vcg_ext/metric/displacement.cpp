#include "displacement.h"

#include "../parallel.h"

#include <algorithm>
#include <cmath>
#include <vcg/space/distance3.h>
#include <vcg/space/triangle3.h>

namespace vcg_ext {

namespace {

struct Sum {
    double squares = 0;
    double area = 0;
    Sum& operator+=(const Sum& other)
    {
        squares += other.squares;
        area += other.area;
        return *this;
    }
};

/// A face that samples may lie next to, with what tells quickly that it is too far.
struct Nearby {
    std::array<Point, 3> corner;
    Point centre;
    Point normal; ///< unit, or zero
    double radius = 0;
};

Nearby nearby(const Points& points, const Triangle& t)
{
    Nearby face;
    for (int k = 0; k < 3; ++k)
        face.corner[k] = points[t[k]];
    face.centre = (face.corner[0] + face.corner[1] + face.corner[2]) / 3;
    face.normal = scaled_normal(points, t).normalized();
    for (const Point& corner : face.corner)
        face.radius = std::max(face.radius, (corner - face.centre).norm());
    return face;
}

double distance(const Point& p, const Nearby& face)
{
    const auto relative = [&](int k) {
        const Point q = face.corner[k] - p;
        return vcg::Point3d(q.x(), q.y(), q.z());
    };
    double distance = 0;
    vcg::Point3d nearest;
    vcg::TrianglePointDistance(vcg::Triangle3<double>(relative(0), relative(1), relative(2)), vcg::Point3d(0, 0, 0),
                               distance, nearest);
    return nearest.Norm();
}

/// \param faces the sample's own first: it is nearly always the nearest, and rules the others out
double distance(const Point& p, const std::vector<Nearby>& faces)
{
    double least = distance(p, faces[0]);
    for (std::size_t i = 1; i < faces.size(); ++i) {
        const Point from_centre = p - faces[i].centre;
        const bool too_far =
            std::abs(from_centre.dot(faces[i].normal)) >= least || from_centre.norm() - faces[i].radius >= least;
        if (!too_far)
            least = std::min(least, distance(p, faces[i]));
    }
    return least;
}

std::vector<Nearby> face_and_ring(const Points& points, const std::vector<Triangle>& triangles,
                                  const VertexFaces& around, int face)
{
    std::vector<int> ring;
    for (const int v : triangles[face])
        ring.insert(ring.end(), around.begin(v), around.end(v));
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    std::vector<Nearby> faces = {nearby(points, triangles[face])};
    for (const int f : ring)
        if (f != face)
            faces.push_back(nearby(points, triangles[f]));
    return faces;
}

/// Three points of equal weight integrate a quadratic over a triangle exactly, and the squared distance to a plane is
/// one.
const std::array<Point, 3> quadrature = {Point(4, 1, 1) / 6, Point(1, 4, 1) / 6, Point(1, 1, 4) / 6};

double rms_one_way(const Points& from, const Points& to, const std::vector<Triangle>& triangles,
                   const VertexFaces& around)
{
    const int faces = static_cast<int>(triangles.size());
    const int stride = std::max(1, faces / 32768);
    const Sum sum = ordered_sum((faces + stride - 1) / stride, Sum(), [&](int i) {
        const Triangle& t = triangles[i * stride];
        const std::vector<Nearby> faces = face_and_ring(to, triangles, around, i * stride);
        const double area = scaled_normal(from, t).norm();
        double squares = 0;
        for (const Point& w : quadrature) {
            const double d = distance(w[0] * from[t[0]] + w[1] * from[t[1]] + w[2] * from[t[2]], faces);
            squares += d * d;
        }
        return Sum{area * squares / static_cast<double>(quadrature.size()), area};
    });
    return sum.area > 0 ? std::sqrt(sum.squares / sum.area) : 0;
}

} // namespace

double max_displacement(const Points& before, const Points& after)
{
    double most = 0;
    for (std::size_t v = 0; v < before.size(); ++v)
        most = std::max(most, (after[v] - before[v]).squaredNorm());
    return std::sqrt(most);
}

int moved_count(const Points& before, const Points& after)
{
    int moved = 0;
    for (std::size_t v = 0; v < before.size(); ++v)
        moved += before[v] != after[v];
    return moved;
}

double local_mrms(const Points& before, const Points& after, const std::vector<Triangle>& triangles,
                  const VertexFaces& around)
{
    return std::max(rms_one_way(before, after, triangles, around), rms_one_way(after, before, triangles, around));
}

} // namespace vcg_ext
