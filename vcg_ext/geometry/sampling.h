// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/surface.h"
#include "../key/stream.h"

#include <string_view>

namespace vcg_ext {

/// Points spread over a surface: as many on every part as it has of the area, one at a random place in each
/// of equal shares.
class Sampling {
public:
    /// \param surface must outlive it, and have a face with an area
    Sampling(const Surface& surface, int count);

    struct Place {
        int face;
        Point weights; ///< of the face's corners
    };

    [[nodiscard]] int count() const { return count_; }

    /// In share `number` of the area. \param draws gives three numbers
    [[nodiscard]] Place place(int number, Stream& draws) const;

    [[nodiscard]] Point point(const Place& place) const;

private:
    const Surface& surface_;
    int count_;
    double area_ = 0; ///< twice
    std::vector<double> cumulative_;
};

/// The point of a face that is the weighted mean of its corners.
[[nodiscard]] inline Point weighted_point(const Surface& surface, int face, const Point& weights)
{
    const Triangle& t = surface.triangles[face];
    return weights[0] * surface.points[t[0]] + weights[1] * surface.points[t[1]] + weights[2] * surface.points[t[2]];
}

/// Places of a surface with its unit normals there.
struct SurfaceSamples {
    std::vector<int> faces;
    Points points;
    Points normals; ///< of the faces
};

/// One place in each of `count` equal shares of the area, in random order: the first of them are spread over all of it
/// too. \param purpose see seeded_stream()
[[nodiscard]] SurfaceSamples sample_surface(const Surface& surface, int count, std::string_view purpose);

/// Some points spread over all.
struct Spread {
    std::vector<int> chosen;  ///< their numbers among all
    std::vector<int> nearest; ///< per point the one nearest to it, as its place in `chosen`
};

/// `count` points each of which is as far as can be from those before it; the first is number 0.
[[nodiscard]] Spread farthest_points(const Points& points, int count);

} // namespace vcg_ext
