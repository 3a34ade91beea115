// SPDX-License-Identifier: GPL-3.0-or-later
#include "copy.h"

#include "../base/parallel.h"

namespace vcg_ext {

namespace {
/// Distances under seven unknowns over those under twelve, above which a copy counts as stretched: more unknowns than
/// are needed would follow the noise.
constexpr double stretched = 1.1;
} // namespace

Surface laid_by(const Eigen::Affine3d& pose, const Surface& surface, const Registration& registration)
{
    Surface laid = surface;
    for_each_index(static_cast<int>(laid.points.size()), [&](int v) { laid.points[v] = pose * laid.points[v]; });
    if (registration.mirrored() != registration.inside_out)
        turn_round(laid);
    return laid;
}

Surface laid_on_original(const Surface& surface, const Registration& registration)
{
    const bool affine = registration.stretched_less > stretched;
    return laid_by(affine ? registration.affine : registration.pose, surface, registration);
}

const Surface& Copy::laid() const
{
    if (!laid_)
        laid_ = laid_on_original(surface, registration);
    return *laid_;
}

const std::vector<Foot>& Copy::feet() const
{
    constexpr double reach = 0.1; // of the original's size
    if (!feet_) {
        const Points& points = laid().points;
        feet_.emplace(points.size());
        for_chunks(static_cast<int>(points.size()), 512, [&](int begin, int end) {
            for (int v = begin; v < end; ++v)
                (*feet_)[v] = registrar.original()(points[v], reach * registrar.size());
        });
    }
    return *feet_;
}

const std::vector<char>& Copy::left() const
{
    constexpr double reach = 0.03; // of the original's size: further than wear moves a surface
    if (!left_) {
        const FootSearch search(laid());
        const Points& places = original.points;
        left_.emplace(places.size());
        for_chunks(static_cast<int>(places.size()), 512, [&](int begin, int end) {
            for (int v = begin; v < end; ++v) {
                const Foot foot = search(places[v], reach * registrar.size());
                (*left_)[v] = foot.face >= 0 && !foot.on_rim ? 1 : 0;
            }
        });
    }
    return *left_;
}

} // namespace vcg_ext
