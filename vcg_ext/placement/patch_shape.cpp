// SPDX-License-Identifier: GPL-3.0-or-later
#include "patch_shape.h"

#include "../base/vectorized.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace vcg_ext {

double PatchShape::ratio() const
{
    constexpr double limit = 1e6;
    return variances[0] > 0 ? variances[0] / std::max(variances[2], variances[0] / limit) : 1;
}

PatchShape patch_shape(const Points& band, const std::vector<int>& vertices)
{
    PatchShape shape;
    shape.samples = static_cast<int>(vertices.size());
    if (vertices.empty())
        return shape;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const int v : vertices)
        covariance += band[v] * band[v].transpose();
    covariance /= shape.samples;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    shape.variances = solver.eigenvalues().reverse().cwiseMax(0);
    shape.axes = solver.eigenvectors().rowwise().reverse();
    return shape;
}

namespace {

/// One patch in its shape's axes, and the displacements that multipliers ask for.
class Problem {
public:
    /// \param normals of each of `vertices`
    Problem(const PatchShape& shape, const Points& band, const Points& normals, const std::vector<int>& vertices)
        : count_(static_cast<int>(vertices.size())), groups_((vertices.size() + lanes - 1) / lanes)
    {
        for (int i = 0; i < count_; ++i) {
            const Point h = shape.axes.transpose() * band[vertices[i]];
            const Point n = shape.axes.transpose() * normals[i];
            Group& group = groups_[i / lanes];
            for (int k = 0; k < 3; ++k) {
                group.h[k].value[i % lanes] = h[k];
                group.n[k].value[i % lanes] = n[k];
            }
        }
    }

    /// d of each vertex, along the shape's axes.
    /// \param b each below `softness`
    [[nodiscard]] Points displacements(const Point& b) const
    {
        Points result(count_);
        for (int i = 0; i < count_; ++i) {
            const Moved group = moved(groups_[i / lanes], Prices(b));
            for (int k = 0; k < 3; ++k)
                result[i][k] = group.d[k][i % lanes];
        }
        return result;
    }

    /// The variances along the axes after that move.
    [[nodiscard]] Point variances(const Point& b) const
    {
        Lanes sums[3] = {};
        add_squares(groups_, Prices(b), sums);
        Point result;
        for (int k = 0; k < 3; ++k)
            result[k] = (sums[k][0] + sums[k][1] + sums[k][2] + sums[k][3]) / count_;
        return result;
    }

    static constexpr double softness = 0.05; ///< price of a move along the surface beside one off it, 1

private:
    /// Bands and normals of some vertices; zeros where there are no more.
    struct Group {
        StoredLanes h[3] = {};
        StoredLanes n[3] = {};
    };

    /// c = 1 / (softness - b), and c b.
    struct Prices {
        explicit Prices(const Point& b)
        {
            for (int k = 0; k < 3; ++k) {
                c[k] = 1 / (softness - b[k]);
                cb[k] = c[k] * b[k];
            }
        }

        double c[3];
        double cb[3];
    };

    struct Moved {
        Lanes d[3];
    };

    /// By Sherman and Morrison's formula.
    static Moved moved(const Group& group, const Prices& prices)
    {
        Moved result;
        Lanes along = {};
        Lanes price = {1, 1, 1, 1};
        for (int k = 0; k < 3; ++k) {
            const Lanes& n = group.n[k].value;
            result.d[k] = prices.cb[k] * group.h[k].value;
            along += n * result.d[k];
            price += prices.c[k] * n * n;
        }
        const Lanes back = along / price;
        for (int k = 0; k < 3; ++k)
            result.d[k] -= prices.c[k] * group.n[k].value * back;
        return result;
    }

    VCG_EXT_VECTORIZED static void add_squares(const std::vector<Group>& groups, const Prices& prices, Lanes* sums)
    {
        for (const Group& group : groups) {
            const Moved move = moved(group, prices);
            for (int k = 0; k < 3; ++k) {
                const Lanes after = group.h[k].value + move.d[k];
                sums[k] += after * after;
            }
        }
    }

    int count_;
    std::vector<Group> groups_;
};

/// `weights . variances >= bound`, and its multiplier, by which it adds `weights` to B's diagonal.
struct Condition {
    Point weights;
    double bound = 0;
    double multiplier = 0;

    [[nodiscard]] bool holds(const Point& variances, double tolerance = 0) const
    {
        return weights.dot(variances) >= bound - tolerance * weights.cwiseAbs().dot(variances);
    }
};

/// The shape that a bit asks for, and enough energy to stand above what an attack adds.
std::vector<Condition> conditions(bool squash, double ratio, double energy)
{
    if (squash)
        return {{{1, 0, -ratio}}, {{1, 0, 0}, energy}};
    return {{{-1, 0, ratio}},    {{0, -1, ratio}},    {{-1, ratio, 0}},
            {{0, 0, 1}, energy}, {{0, 1, 0}, energy}, {{1, 0, 0}, energy}};
}

/// The least multiplier with which the condition holds, beside the others' part `b` of the diagonal; the largest
/// allowed one where none is enough.
double least_multiplier(const Problem& problem, const Condition& condition, const Point& b)
{
    constexpr double most = 0.999; // of softness: beyond it a move along the surface has no end
    if (condition.holds(problem.variances(b)))
        return 0;
    double low = 0;
    double high = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k)
        if (condition.weights[k] > 0)
            high = std::min(high, std::max(0.0, (most * Problem::softness - b[k]) / condition.weights[k]));
    for (int i = 0; i < 20; ++i) {
        const double middle = (low + high) / 2;
        (condition.holds(problem.variances(b + middle * condition.weights)) ? high : low) = middle;
    }
    return high;
}

/// B's diagonal by coordinate ascent on the dual, one multiplier after the other.
Point solve(const Problem& problem, std::vector<Condition> conditions)
{
    constexpr double tolerance = 0.003;
    constexpr int sweeps = 10;
    Point b = Point::Zero();
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        const Point reached = problem.variances(b);
        if (std::all_of(conditions.begin(), conditions.end(),
                        [&](const Condition& c) { return c.holds(reached, tolerance); }))
            break;
        for (Condition& condition : conditions) {
            b -= condition.multiplier * condition.weights;
            condition.multiplier = least_multiplier(problem, condition, b);
            b += condition.multiplier * condition.weights;
        }
    }
    return b;
}

} // namespace

Points least_change(const PatchShape& shape, const Points& band, const Points& normals,
                    const std::vector<int>& vertices, bool squash, double ratio, double energy)
{
    const Problem problem(shape, band, normals, vertices);
    const Point b = solve(problem, conditions(squash, ratio, energy));
    Points moves = problem.displacements(b);
    for (Point& move : moves)
        move = shape.axes * move;
    return moves;
}

Points printed_change(const PatchShape& shape, const Points& band, const std::vector<int>& vertices, double ratio)
{
    Point factor = Point::Zero();
    for (int k = 1; k < 3; ++k)
        if (shape.variances[k] > 0)
            factor[k] = std::sqrt(shape.variances[0] / (ratio * shape.variances[k])) - 1;
    const Eigen::Matrix3d change = shape.axes * factor.asDiagonal() * shape.axes.transpose();
    Points moves;
    for (const int v : vertices)
        moves.emplace_back(change * band[v]);
    return moves;
}

} // namespace vcg_ext
