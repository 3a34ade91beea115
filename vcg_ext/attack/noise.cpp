// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise.h"

#include "../base/weld.h"
#include "../geometry/centre.h"
#include "../key/random.h"
#include "../key/stream.h"

#include <algorithm>
#include <cmath>

namespace vcg_ext {

Points noise(const Surface& surface, double amplitude, std::uint64_t seed)
{
    const Welded welded = weld(surface);
    const Point centre = area_centre(welded.surface.points, welded.surface.triangles);
    Points moved = welded.surface.points;
    double farthest = 0;
    for (const Point& p : moved)
        farthest = std::max(farthest, (p - centre).squaredNorm());
    const double length = amplitude * std::sqrt(farthest);

    Stream stream = seeded_stream(seed, "noise");
    for (Point& p : moved)
        p += length * direction<3>(stream);
    return unweld(surface.points, welded.site_of_vertex, moved);
}

} // namespace vcg_ext
