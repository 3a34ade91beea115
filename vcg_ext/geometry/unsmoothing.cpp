// SPDX-License-Identifier: GPL-3.0-or-later
#include "unsmoothing.h"

#include "../base/median.h"
#include "../base/parallel.h"
#include "normals.h"
#include "umbrella.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

namespace vcg_ext {

namespace {

constexpr double reach = 0.3; ///< of feet, in sizes
constexpr int few_steps = 8;
constexpr int most_steps = 20; ///< more follow the noise
constexpr int most_ways = 3;

using Twelve = Eigen::Matrix<double, 12, 1>;

Points smoothed(const EdgeGraph& graph, Points points, int rounds)
{
    return umbrella_steps(graph, std::move(points), 0.5, rounds);
}

/// 1.48 times the median of the absolute values.
double spread_of(std::vector<double> values)
{
    for (double& value : values)
        value = std::abs(value);
    return 1.4826 * median(std::move(values));
}

/// Moves and stretches points so that what is left along the normals becomes least, in one robust step.
void refit(const Points& normals, const std::vector<double>& left, double spread, Points& points)
{
    struct Sums {
        Eigen::Matrix<double, 12, 12> normal;
        Twelve right;
        Sums& operator+=(const Sums& other)
        {
            normal += other.normal;
            right += other.right;
            return *this;
        }
    };
    const int count = static_cast<int>(points.size());
    const Point centre = ordered_sum(count, Point(Point::Zero()), [&](int v) { return points[v]; }) / count;
    const Sums zero{Eigen::Matrix<double, 12, 12>::Zero(), Twelve::Zero()};
    Sums sums = ordered_sum(count, zero, [&](int v) {
        const double r = left[v] / (3 * spread + 1e-300);
        const Point p = points[v] - centre;
        Twelve j;
        j << normals[v], p[0] * normals[v], p[1] * normals[v], p[2] * normals[v];
        const double weight = 1 / (1 + r * r);
        return Sums{weight * j * j.transpose(), -weight * left[v] * j};
    });
    sums.normal.diagonal() *= 1 + 1e-9;
    const Twelve u = sums.normal.ldlt().solve(sums.right);
    if (!u.allFinite())
        return;
    Eigen::Matrix3d stretch;
    stretch << u.segment<3>(3), u.segment<3>(6), u.segment<3>(9);
    for_each_index(count, [&](int v) { points[v] += u.head<3>() + stretch * (points[v] - centre); });
}

} // namespace

Unsmoothed unsmooth(const FootSearch& original, double size, const Surface& laid, const EdgeGraph& graph, int rounds,
                    int steps)
{
    const int count = static_cast<int>(laid.points.size());
    Unsmoothed result;
    result.rounds = rounds;
    result.laid = laid.points;
    result.feet.resize(count);
    Points now = laid.points;
    const auto project = [&](const Points& to) {
        for_each_index(count, [&](int v) {
            if (const Foot foot = original(to[v], reach * size); foot.face >= 0) {
                result.feet[v] = foot;
                now[v] = foot.point;
            }
        });
    };
    project(now);
    Points before = now;
    std::vector<double> left(count);
    for (int step = 0; step < steps; ++step) {
        const double momentum = step > 1 ? step / (step + 3.0) : 0;
        Points ahead(count);
        for_each_index(count, [&](int v) { ahead[v] = now[v] + momentum * (now[v] - before[v]); });
        const Points there = smoothed(graph, ahead, rounds);
        for_each_index(count, [&](int v) { ahead[v] += result.laid[v] - there[v]; });
        before = now;
        project(ahead);
        result.smoothed = smoothed(graph, now, rounds);
        result.normals = vertex_normals(result.smoothed, laid.triangles);
        for_each_index(count, [&](int v) { left[v] = (result.laid[v] - result.smoothed[v]).dot(result.normals[v]); });
        result.spread = spread_of(left);
        if (step >= 2)
            refit(result.normals, left, result.spread, result.laid);
    }
    return result;
}

std::vector<Unsmoothed> unsmoothings(const FootSearch& original, double size, const Surface& laid,
                                     const EdgeGraph& graph, int start)
{
    std::map<int, double> tried;
    const auto spread = [&](int rounds) {
        const auto known = tried.find(rounds);
        return known != tried.end() ? known->second
                                    : tried[rounds] = unsmooth(original, size, laid, graph, rounds, few_steps).spread;
    };
    int best = std::max(1, start);
    for (int step = std::max(1, static_cast<int>(std::lround(0.4 * best))); step > 0;) {
        const int before = best;
        for (const int rounds : {before - step, before + step})
            if (rounds > 0 && spread(rounds) < spread(best))
                best = rounds;
        if (best == before)
            step /= 2;
    }
    std::vector<std::pair<double, int>> order;
    for (const auto& [rounds, left] : tried)
        order.emplace_back(left, rounds);
    std::sort(order.begin(), order.end());
    std::vector<Unsmoothed> ways;
    for (std::size_t i = 0; i < order.size() && i < most_ways; ++i)
        ways.push_back(unsmooth(original, size, laid, graph, order[i].second, most_steps));
    return ways;
}

} // namespace vcg_ext
