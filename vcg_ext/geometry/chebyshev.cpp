// SPDX-License-Identifier: GPL-3.0-or-later
#include "chebyshev.h"

#include "../base/parallel.h"
#include "../base/pi.h"
#include "../base/vectorized.h"
#include "wavefront.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace vcg_ext {

double HighPass::transfer(double eigenvalue) const
{
    const double angle = std::acos(std::clamp(2 * eigenvalue / bound - 1, -1.0, 1.0));
    double sum = 0;
    for (std::size_t k = 0; k < coefficients.size(); ++k)
        sum += coefficients[k] * std::cos(k * angle);
    return sum;
}

HighPass high_pass(double cutoff, double bound, int degree)
{
    const double edge = std::acos(2 * cutoff / bound - 1);
    const double step = pi / (degree + 2);
    HighPass filter;
    filter.bound = bound;
    filter.coefficients.push_back(edge / pi);
    for (int k = 1; k <= degree; ++k) {
        const double jackson =
            ((degree + 2 - k) * std::cos(k * step) + std::sin(k * step) / std::tan(step)) / (degree + 2);
        filter.coefficients.push_back(jackson * 2 * std::sin(k * edge) / (k * pi));
    }
    return filter;
}

int high_pass_degree(double bound)
{
    return static_cast<int>(std::lround(120 * std::sqrt(bound / 24)));
}

namespace {

/// T_0 = x, T_1 = A x, T_(k+1) = 2 A T_k - T_(k-1), with A = 2 L / bound - 1, and what they sum up to.
class Series {
public:
    Series(const HighPass& filter, const EdgeGraph& graph, Points x)
        : filter_(filter), graph_(graph), scale_(2 / filter.bound), sum_(std::move(x))
    {
        for (std::vector<StoredLanes>& terms : terms_)
            terms.resize(sum_.size());
        for_each_index(static_cast<int>(sum_.size()), [&](int v) {
            terms_[0][v].value = Lanes{sum_[v][0], sum_[v][1], sum_[v][2], 0};
        });
    }

    [[nodiscard]] int terms() const { return static_cast<int>(filter_.coefficients.size()); }

    /// Rows [begin, end) of term `k`, which takes the place of term k - 2: that is needed in its own row alone.
    void take(int k, int begin, int end)
    {
        const Rows rows{graph_.first.data(), graph_.neighbour.data(), begin, end};
        StoredLanes* before = terms_[k % 2].data();
        const StoredLanes* now = terms_[(k + 1) % 2].data();
        const double* c = filter_.coefficients.data() + k;
        if (k == 1)
            first_rows(rows, now, before, sum_.data(), scale_, c[-1], c[0]);
        else if (k % 2 == 1 || k + 1 == terms()) // two terms at a time go into the sum
            next_rows(rows, now, before, sum_.data(), scale_, k % 2 == 1 ? c[-1] : 0, c[0]);
        else
            next_rows(rows, now, before, nullptr, scale_, 0, 0);
    }

    /// Of all terms that were taken. They are used up.
    [[nodiscard]] Points sum() { return std::move(sum_); }

private:
    struct Rows {
        const int* first;
        const int* neighbour;
        int begin, end;

        void times(const StoredLanes* x, int v, double scale, Lanes& result) const
        {
            result = x[v].value * static_cast<double>(first[v + 1] - first[v]);
            for (int i = first[v]; i < first[v + 1]; ++i)
                result -= x[neighbour[i]].value;
            result = scale * result - x[v].value;
        }
    };

    VCG_EXT_VECTORIZED static void first_rows(const Rows& rows, const StoredLanes* x, StoredLanes* term, Point* sum,
                                              double scale, double c0, double c1)
    {
        for (int v = rows.begin; v < rows.end; ++v) {
            rows.times(x, v, scale, term[v].value);
            const Lanes part = c0 * x[v].value + c1 * term[v].value;
            sum[v] = {part[0], part[1], part[2]};
        }
    }

    VCG_EXT_VECTORIZED static void next_rows(const Rows& rows, const StoredLanes* now, StoredLanes* before, Point* sum,
                                             double scale, double c_now, double c_next)
    {
        for (int v = rows.begin; v < rows.end; ++v) {
            Lanes next;
            rows.times(now, v, scale, next);
            next = 2 * next - before[v].value;
            before[v].value = next;
            if (sum) {
                const Lanes part = c_now * now[v].value + c_next * next;
                sum[v] += Point(part[0], part[1], part[2]);
            }
        }
    }

    const HighPass& filter_;
    const EdgeGraph& graph_;
    double scale_;
    std::array<std::vector<StoredLanes>, 2> terms_; ///< the even and the odd
    Points sum_;                                    ///< at first x itself
};

} // namespace

Points apply(const HighPass& filter, const EdgeGraph& graph, Points x)
{
    Series series(filter, graph, std::move(x));
    take_steps(graph, 1, series.terms(), [&](int k, int begin, int end) { series.take(k, begin, end); });
    return series.sum();
}

void add_band_of_moves(const HighPass& filter, const EdgeGraph& graph, const std::vector<int>& moved,
                       const Points& moves, Points& band)
{
    const int degree = static_cast<int>(filter.coefficients.size()) - 1;
    const std::vector<int> near = within_rings(graph, moved, degree);
    Points x(near.size(), Point::Zero());
    for (std::size_t i = 0, at = 0; i < moved.size(); ++i) {
        while (near[at] != moved[i])
            ++at;
        x[at] = moves[i];
    }
    const Points change = apply(filter, part_of(graph, near), std::move(x));
    for (std::size_t i = 0; i < near.size(); ++i)
        band[near[i]] += change[i];
}

} // namespace vcg_ext
