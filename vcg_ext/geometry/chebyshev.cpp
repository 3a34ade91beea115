// SPDX-License-Identifier: GPL-3.0-or-later
#include "chebyshev.h"

#include "../base/parallel.h"
#include "../base/pi.h"
#include "../base/vectorized.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
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

/// Where blocks of consecutive vertices begin, and the end: all neighbours of a block are in it and the two beside it.
std::vector<int> blocks_of(const EdgeGraph& graph)
{
    constexpr int least = 1000; // vertices
    std::vector<int> blocks{0};
    int reach = 0; // of the blocks before the last
    for (int v = 0; v < graph.vertices(); ++v) {
        if (v < std::max(reach, blocks.back() + least))
            continue;
        for (int w = blocks.back(); w < v; ++w)
            if (graph.degree(w) > 0)
                reach = std::max(reach, graph.end(w)[-1] + 1);
        blocks.push_back(v);
    }
    blocks.push_back(graph.vertices());
    return blocks;
}

/// T_0 = x, T_1 = A x, T_(k+1) = 2 A T_k - T_(k-1), with A = 2 L / bound - 1, and what they sum up to.
class Series {
public:
    Series(const HighPass& filter, const EdgeGraph& graph, const Points& x)
        : filter_(filter), graph_(graph), scale_(2 / filter.bound), sum_(x.size())
    {
        for (std::vector<StoredLanes>& terms : terms_)
            terms.resize(x.size());
        for_each_index(static_cast<int>(x.size()), [&](int v) {
            for (int axis = 0; axis < 3; ++axis)
                terms_[0][v].value[axis] = x[v][axis];
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

    [[nodiscard]] Points sum() const
    {
        Points result(sum_.size());
        for_each_index(static_cast<int>(sum_.size()), [&](int v) {
            const Lanes& s = sum_[v].value;
            result[v] = {s[0], s[1], s[2]};
        });
        return result;
    }

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

    VCG_EXT_VECTORIZED static void first_rows(const Rows& rows, const StoredLanes* x, StoredLanes* term,
                                              StoredLanes* sum, double scale, double c0, double c1)
    {
        for (int v = rows.begin; v < rows.end; ++v) {
            rows.times(x, v, scale, term[v].value);
            sum[v].value = c0 * x[v].value + c1 * term[v].value;
        }
    }

    VCG_EXT_VECTORIZED static void next_rows(const Rows& rows, const StoredLanes* now, StoredLanes* before,
                                             StoredLanes* sum, double scale, double c_now, double c_next)
    {
        for (int v = rows.begin; v < rows.end; ++v) {
            Lanes next;
            rows.times(now, v, scale, next);
            next = 2 * next - before[v].value;
            before[v].value = next;
            if (sum)
                sum[v].value += c_now * now[v].value + c_next * next;
        }
    }

    const HighPass& filter_;
    const EdgeGraph& graph_;
    double scale_;
    std::array<std::vector<StoredLanes>, 2> terms_; ///< the even and the odd
    std::vector<StoredLanes> sum_;
};

/// Takes `depth` terms from `term` on over blocks, one term a block behind the other, so that rows are still in the
/// processor's cache when they come again.
/// \param ends `ends(i)`: the blocks for the term + i, first and end
template <class Ends>
void take_staggered(Series& series, const std::vector<int>& blocks, int term, int depth, const Ends& ends)
{
    int low = std::numeric_limits<int>::max();
    int high = 0;
    for (int i = 0; i < depth; ++i) {
        low = std::min(low, ends(i).first + i);
        high = std::max(high, ends(i).second + i);
    }
    for (int j = low; j < high; ++j)
        for (int i = 0; i < depth; ++i) {
            const auto [first, end] = ends(i);
            if (const int block = j - i; block >= first && block < end)
                series.take(term + i, blocks[block], blocks[block + 1]);
        }
}

/// Takes `depth` terms over all blocks: first over stretches of them, each by itself, a term reaching less far than the
/// one before by a block at both ends; then over what that left out, about where stretches meet.
void take_terms(Series& series, const std::vector<int>& blocks, int term, int depth, int stretches)
{
    const int count = static_cast<int>(blocks.size()) - 1;
    const auto start = [&](int s) { return static_cast<int>(static_cast<std::int64_t>(count) * s / stretches); };
    for_chunks(stretches, 1, [&](int s, int) {
        take_staggered(series, blocks, term, depth, [&](int i) {
            return std::pair(s == 0 ? 0 : start(s) + i, s + 1 == stretches ? count : start(s + 1) - i);
        });
    });
    for_chunks(stretches - 1, 1, [&](int s, int) {
        take_staggered(series, blocks, term, depth,
                       [&](int i) { return std::pair(start(s + 1) - i, start(s + 1) + i); });
    });
}

} // namespace

Points apply(const HighPass& filter, const EdgeGraph& graph, const Points& x)
{
    constexpr int depth = 4;
    constexpr int stretch = 5 * depth; // blocks
    Series series(filter, graph, x);
    const std::vector<int> blocks = blocks_of(graph);
    const int stretches = static_cast<int>(blocks.size() - 1) / stretch;
    for (int k = 1; k < series.terms(); k += depth) {
        const int terms = std::min(depth, series.terms() - k);
        if (stretches > 1)
            take_terms(series, blocks, k, terms, stretches);
        else // few vertices, or numbered anyhow
            for (int i = 0; i < terms; ++i)
                for_chunks(graph.vertices(), 4096, [&](int begin, int end) { series.take(k + i, begin, end); });
    }
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
    const Points change = apply(filter, part_of(graph, near), x);
    for (std::size_t i = 0; i < near.size(); ++i)
        band[near[i]] += change[i];
}

} // namespace vcg_ext
