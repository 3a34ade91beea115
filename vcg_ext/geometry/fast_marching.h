#pragma once
#include "ray.h"

#include <vector>

namespace vcg_ext {

/// What the front of a wave looks like inside one triangle ABC when it passes from A and B to C.
enum class Wave {
    Circular, ///< a circle about the point beyond AB that lies T(A) from A and T(B) from B
    Plane     ///< a straight line (Kimmel and Sethian 1998; thesis (4.15)-(4.20))
};

struct MarchOptions {
    Wave wave = Wave::Circular;
    /// Where the angle at C is obtuse, look through AB for a vertex that splits it (Kimmel and Sethian). The plane wave
    /// needs that for its accuracy. With the circular wave it gains little, and the distance jumps where an angle
    /// passes 90 degrees.
    bool unfold = false;
};

/// When and from where the front reaches a point.
struct Arrival {
    double distance; ///< infinite where it never does
    Point gradient =
        Point::Zero(); ///< of the distance, at the point: a unit vector in the plane of the triangle it came by
};

/// Approximate geodesic distances from a point of the surface to its vertices, by fast marching in O(V log V).
///
/// The circular wave is exact where the surface unfolds to a plane and each vertex is seen through the triangle it is
/// reached by. On real meshes the root mean square error is some .3 %, that of the plane wave 1-2 %.
///
/// \param around  of the surface's own triangles
/// \return one a vertex; an infinite distance where no path of faces leads to it
[[nodiscard]] std::vector<Arrival> march(const Surface& surface, const VertexFaces& around, const SurfacePoint& source,
                                         const MarchOptions& options = {});

/// When the front would reach `vertex`, were it at `position`.
///
/// march() gives each vertex this value, taken over the vertices that the front reached before.
/// \param distance one a vertex; infinite where the front has not been yet
[[nodiscard]] Arrival arrival(const Surface& surface, const VertexFaces& around, const std::vector<double>& distance,
                              int vertex, const Point& position, const MarchOptions& options = {});

} // namespace vcg_ext
