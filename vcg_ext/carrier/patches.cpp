// SPDX-License-Identifier: GPL-3.0-or-later
#include "patches.h"

#include "../base/error.h"
#include "../base/parallel.h"
#include "../geometry/laplacian.h"
#include "../geometry/umbrella.h"

#include <algorithm>
#include <numeric>

namespace vcg_ext {

int Patches::flipped(int patch, AxisFlips flips) const
{
    const int layer = patch / columns;
    const int column = patch % columns;
    return (flips.second ? layers - 1 - layer : layer) * columns + (flips.first ? columns - 1 - column : column);
}

int patch_count(int bits, int layers)
{
    const int wanted = bits + std::max(6, bits / 10);
    return (wanted + layers - 1) / layers * layers;
}

std::vector<std::vector<int>> patch_vertices(const Patches& patches)
{
    std::vector<std::vector<int>> vertices(patches.count());
    for (std::size_t v = 0; v < patches.label.size(); ++v)
        if (patches.label[v] >= 0)
            vertices[patches.label[v]].push_back(static_cast<int>(v));
    return vertices;
}

void check_frame(const Frame& frame)
{
    if (frame.measure == 0)
        throw Error("No face of the mesh has an area. Check its coordinates, or reconstruct the surface.");
}

Points in_frame(Points points, const Frame& frame)
{
    for_each_index(static_cast<int>(points.size()),
                   [&](int v) { points[v] = frame.axes.transpose() * (points[v] - frame.centre); });
    return points;
}

namespace {

/// Area over a coordinate, in fine steps.
class AreaProfile {
public:
    AreaProfile(double low, double high) : low_(low), width_((high - low) / steps), area_(steps, 0.0) {}

    void add(double x, double area)
    {
        const int step = width_ > 0 ? static_cast<int>((x - low_) / width_) : 0;
        area_[std::clamp(step, 0, steps - 1)] += area;
    }

    AreaProfile& operator+=(const AreaProfile& other)
    {
        for (int i = 0; i < steps; ++i)
            area_[i] += other.area_[i];
        return *this;
    }

    /// The coordinates below which these shares of the area lie.
    /// \param shares ascending, in [0, 1]
    [[nodiscard]] std::vector<double> cuts(const std::vector<double>& shares) const
    {
        const double total = std::accumulate(area_.begin(), area_.end(), 0.0);
        std::vector<double> cuts;
        double below = 0;
        int step = 0;
        for (const double share : shares) {
            while (step < steps - 1 && below + area_[step] < share * total)
                below += area_[step++];
            const double part = area_[step] > 0 ? (share * total - below) / area_[step] : 0;
            cuts.push_back(low_ + width_ * (step + std::clamp(part, 0.0, 1.0)));
        }
        return cuts;
    }

private:
    static constexpr int steps = 1 << 14;
    double low_;
    double width_;
    std::vector<double> area_;
};

/// Calls `visit(centroid, area)` for the n^2 equal parts of a triangle.
template <int n, class Visit>
void visit_parts(const Points& points, const Triangle& t, const Visit& visit)
{
    const double area = scaled_normal(points, t).norm() / 2 / (n * n);
    const Point& origin = points[t[0]];
    const Point a = (points[t[1]] - origin) / n;
    const Point b = (points[t[2]] - origin) / n;
    for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j) {
            visit(origin + (i + 1.0 / 3) * a + (j + 1.0 / 3) * b, area);
            if (i + j < n - 1)
                visit(origin + (i + 2.0 / 3) * a + (j + 2.0 / 3) * b, area);
        }
}

/// Profiles of the surface's area: `add(profiles, centroid, area)` for each small part. Summed in a fixed order.
template <class Add>
std::vector<AreaProfile> area_profiles(const Points& points, const std::vector<Triangle>& triangles,
                                       const std::vector<AreaProfile>& empty, const Add& add)
{
    constexpr int pieces = 16;
    constexpr int many = 500000; // where triangles are so small, an eighth of one more or less moves no cut
    const int count = static_cast<int>(triangles.size());
    const int chunk = (count + pieces - 1) / pieces;
    std::vector<std::vector<AreaProfile>> partial(pieces, empty);
    for_chunks(count, chunk, [&](int begin, int end) {
        std::vector<AreaProfile>& mine = partial[begin / chunk];
        for (int f = begin; f < end; ++f) {
            const auto take = [&](const Point& p, double area) { add(mine, p, area); };
            count < many ? visit_parts<4>(points, triangles[f], take) : visit_parts<2>(points, triangles[f], take);
        }
    });
    std::vector<AreaProfile> total = empty;
    for (const std::vector<AreaProfile>& piece : partial)
        for (std::size_t i = 0; i < total.size(); ++i)
            total[i] += piece[i];
    return total;
}

std::vector<double> equal_shares(int pieces)
{
    std::vector<double> shares;
    for (int i = 0; i <= pieces; ++i)
        shares.push_back(static_cast<double>(i) / pieces);
    return shares;
}

/// The piece of `cuts` that holds `x`; what lies outside counts to the first or the last.
int piece_of(const std::vector<double>& cuts, double x)
{
    return static_cast<int>(std::upper_bound(cuts.begin() + 1, cuts.end() - 1, x) - cuts.begin()) - 1;
}

} // namespace

Patches equal_area_patches(const Points& vertices, const SolidTopology& topology, const EdgeGraph& graph,
                           const Frame& frame, int layers, int columns, double trim)
{
    check_frame(frame);
    constexpr int passes = 10;
    Points smooth = taubin(graph, vertices, passes);
    smooth.resize(topology.points());
    place_apexes(topology, smooth);
    smooth = in_frame(std::move(smooth), frame);
    const Eigen::AlignedBox3d box = bounding_box(smooth);
    const AreaProfile along_first(box.min().x(), box.max().x());
    const AreaProfile along_second(box.min().y(), box.max().y());
    const auto profiles = [&](const std::vector<AreaProfile>& empty, const auto& add) {
        return area_profiles(smooth, topology.triangles, empty, add);
    };

    const std::vector<double> ends =
        profiles({along_first}, [](auto& profile, const Point& p, double area) { profile[0].add(p.x(), area); })[0]
            .cuts({trim, 1 - trim});
    const auto inside = [&ends](const Point& p) { return p.x() >= ends[0] && p.x() < ends[1]; };
    const std::vector<double> layer_cuts = profiles({along_second},
                                                    [&](auto& profile, const Point& p, double area) {
                                                        if (inside(p))
                                                            profile[0].add(p.y(), area);
                                                    })[0]
                                               .cuts(equal_shares(layers));
    const std::vector<AreaProfile> layer_profiles =
        profiles(std::vector<AreaProfile>(layers, along_first), [&](auto& profile, const Point& p, double area) {
            if (inside(p))
                profile[piece_of(layer_cuts, p.y())].add(p.x(), area);
        });
    std::vector<std::vector<double>> column_cuts;
    column_cuts.reserve(layer_profiles.size());
    for (const AreaProfile& profile : layer_profiles)
        column_cuts.push_back(profile.cuts(equal_shares(columns)));

    Patches patches{layers, columns, std::vector<int>(topology.sites, -1)};
    for_each_index(topology.sites, [&](int v) {
        if (!inside(smooth[v]))
            return;
        const int layer = piece_of(layer_cuts, smooth[v].y());
        patches.label[v] = layer * columns + piece_of(column_cuts[layer], smooth[v].x());
    });
    return patches;
}

} // namespace vcg_ext
