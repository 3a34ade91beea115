// SPDX-License-Identifier: GPL-3.0-or-later
#include "sew.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace vcg_ext {

namespace {

/// Cells of space and what they hold; a hash says which, so two cells may share a list.
class Grid {
public:
    Grid(const Point& origin, double width) : origin_(origin), width_(width) {}

    void add(const Point& p, int number) { cells_[key(cell(p))].push_back(number); }

    /// Calls `visit(number)` for what lies within a cell's width of `p`, and for some that does not.
    template <class Visit>
    void visit_near(const Point& p, const Visit& visit) const
    {
        const Cell at = cell(p);
        for (int step = 0; step < 27; ++step) {
            const auto found = cells_.find(key(at + Cell(step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1)));
            if (found != cells_.end())
                for (const int number : found->second)
                    visit(number);
        }
    }

private:
    using Cell = Eigen::Array<std::int64_t, 3, 1>;

    [[nodiscard]] Cell cell(const Point& p) const
    {
        return ((p - origin_) / width_).array().floor().cast<std::int64_t>();
    }

    static std::uint64_t key(const Cell& c)
    {
        return static_cast<std::uint64_t>(c[0]) * 0x9E3779B97F4A7C15U ^
               static_cast<std::uint64_t>(c[1]) * 0xC2B2AE3D27D4EB4FU ^
               static_cast<std::uint64_t>(c[2]) * 0x165667B19E3779F9U;
    }

    Point origin_;
    double width_;
    std::unordered_map<std::uint64_t, std::vector<int>> cells_;
};

} // namespace

std::vector<int> sewn_to(const Points& points, const std::vector<EdgeUse>& edges, double reach)
{
    std::vector<int> head(points.size());
    std::iota(head.begin(), head.end(), 0);
    std::vector<int> rim;
    std::vector<double> limit(points.size(), reach);
    for (const EdgeUse& e : edges)
        for (const int v : {e.low, e.high}) {
            rim.push_back(v);
            limit[v] = std::min(limit[v], (points[e.high] - points[e.low]).norm() / 4);
        }
    std::sort(rim.begin(), rim.end());
    rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
    double extent = 0;
    for (const int v : rim)
        extent = std::max(extent, (points[v] - points[rim.front()]).cwiseAbs().maxCoeff());
    if (!(reach * 1e15 > extent))
        return head; // nothing lies together that doubles can tell apart
    Grid heads(points[rim.front()], reach);
    for (const int v : rim) {
        double best = std::numeric_limits<double>::infinity();
        heads.visit_near(points[v], [&](int w) {
            const double d = (points[w] - points[v]).norm();
            if (d < best && d <= std::min(limit[v], limit[w])) {
                best = d;
                head[v] = w;
            }
        });
        if (head[v] == v)
            heads.add(points[v], v);
    }
    return head;
}

} // namespace vcg_ext
