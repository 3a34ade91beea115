// SPDX-License-Identifier: GPL-3.0-or-later
#include "mirror.h"

namespace vcg_ext {

Surface mirror(const Surface& surface)
{
    Surface image = surface;
    for (Point& p : image.points)
        p.x() = -p.x();
    turn_round(image);
    return image;
}

} // namespace vcg_ext
