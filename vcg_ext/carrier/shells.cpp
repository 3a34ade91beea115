// SPDX-License-Identifier: GPL-3.0-or-later
#include "shells.h"

#include "../base/error.h"
#include "../base/parallel.h"
#include "../geometry/centre.h"

namespace vcg_ext {

std::vector<double> norms(const Points& points, const Point& centre)
{
    std::vector<double> result(points.size());
    for_each_index(static_cast<int>(points.size()), [&](int v) { result[v] = (points[v] - centre).norm(); });
    return result;
}

ShellFrame shell_frame(const Surface& surface)
{
    return shell_frame(surface.points, surface.triangles, hole_fans(surface));
}

ShellFrame shell_frame(const Points& points, const std::vector<Triangle>& triangles, const HoleFans& holes)
{
    ShellFrame frame;
    frame.centre = holes.apexes == 0 ? area_centre(points, triangles)
                                     : area_centre(solid_points(holes, points), triangles, holes.fans);
    const auto norm = [&](int v) { return (points[v] - frame.centre).norm(); };
    const Range range = range_of(static_cast<int>(points.size()), norm);
    frame.minimum = range.least;
    frame.maximum = range.most;
    if (!(frame.maximum - frame.minimum > 1e-9 * frame.maximum))
        throw Error("All vertices are equally far from the mesh's centre, so their distances cannot carry a message. "
                    "Use another method, or another mesh.");
    return frame;
}

Carriers shells(const Points& points, const ShellFrame& frame, double trim, int count)
{
    const auto norm = [&](int v) { return (points[v] - frame.centre).norm(); };
    return cut_range_of(static_cast<int>(points.size()), norm, frame.minimum, frame.maximum, trim, count);
}

} // namespace vcg_ext
