// SPDX-License-Identifier: GPL-3.0-or-later
#include "mirror.h"

#include <utility>

namespace vcg_ext {

Surface mirror(const Surface& surface)
{
    Surface image = surface;
    for (Point& p : image.points)
        p.x() = -p.x();
    for (Triangle& t : image.triangles)
        std::swap(t[1], t[2]);
    return image;
}

} // namespace vcg_ext
