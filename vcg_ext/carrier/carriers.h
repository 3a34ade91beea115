// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/parallel.h"
#include "statistic.h"

#include <vector>

namespace vcg_ext {

/// Where the bits of a scalar method live: which vertex belongs to which carrier, and its value there.
/// Shells of vertex norms and strips of geodesic distances both end up here.
struct Carriers {
    int count = 0;
    double low = 0;            ///< scalar at which carrier 0 begins
    double width = 0;          ///< scalar width of each; carrier k is [low + k width, low + (k + 1) width)
    std::vector<int> label;    ///< per vertex its carrier, or -1
    std::vector<double> value; ///< per vertex its place in the carrier, in [0, 1); 0 where label is -1

    /// The scalar at place `x` of carrier `label`.
    [[nodiscard]] double scalar(int label, double x) const { return low + width * (label + x); }
};

/// Cuts the range between `minimum` and `maximum` of a scalar: `trim` of it off at both ends, `count` equal widths
/// between ((5.2)-(5.6), (4.6) with its offset put right).
/// \param scalar `scalar(v)`, vertices from 0 on; negative or infinite: no carrier
template <class Scalar>
[[nodiscard]] Carriers cut_range_of(int vertices, const Scalar& scalar, double minimum, double maximum, double trim,
                                    int count)
{
    Carriers carriers;
    carriers.count = count;
    carriers.low = minimum + trim * (maximum - minimum);
    carriers.width = (1 - 2 * trim) * (maximum - minimum) / count;
    carriers.label.assign(vertices, -1);
    carriers.value.assign(vertices, 0);
    for_each_index(vertices, [&](int v) {
        const double here = scalar(v);
        const double place = (here - carriers.low) / carriers.width;
        if (!(here >= 0 && place >= 0 && place < count))
            return;
        carriers.label[v] = static_cast<int>(place);
        carriers.value[v] = place - carriers.label[v];
    });
    return carriers;
}

/// The same of scalars that are there, one per vertex.
[[nodiscard]] Carriers cut_range(const std::vector<double>& scalar, double minimum, double maximum, double trim,
                                 int count);

/// How many vertices each carrier has.
[[nodiscard]] std::vector<int> samples(const Carriers& carriers);

/// Per carrier the statistic that detection reads: the mean of x, threshold 1/2, or of (2x - 1)^2, threshold 1/3.
/// A carrier without vertices has the threshold itself.
[[nodiscard]] std::vector<double> statistics(const Carriers& carriers, Statistic statistic);

} // namespace vcg_ext
