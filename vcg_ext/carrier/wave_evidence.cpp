// SPDX-License-Identifier: GPL-3.0-or-later
#include "wave_evidence.h"

#include "../base/parallel.h"
#include "../base/pi.h"
#include "../base/vectorized.h"
#include "../geometry/turns.h"
#include "../payload/cosine_tail.h"
#include "../payload/evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vcg_ext {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// log(exp(a) + exp(b))
double log_add(double a, double b)
{
    const double high = std::max(a, b);
    return high == -never ? high : high + std::log1p(std::exp(std::min(a, b) - high));
}

/// The logarithm of a sum, of which the logarithms of the terms are known.
class LogSum {
public:
    void add(double log_term)
    {
        if (log_term > highest_) {
            sum_ = sum_ * std::exp(highest_ - log_term) + 1;
            highest_ = log_term;
        } else if (log_term > highest_ - 40) { // the others are below the rounding
            sum_ += std::exp(log_term - highest_);
        }
    }

    [[nodiscard]] double log() const { return highest_ + std::log(sum_); }

private:
    double highest_ = -never;
    double sum_ = 0; ///< over exp(highest_)
};

/// One row of a view's grid, u by u: cos 2 pi y_k, by Chebyshev's cos(a + d) = 2 cos d cos a - cos(a - d).
class RowScan {
public:
    static constexpr int lanes = 8;

    static std::size_t padded(std::size_t waves) { return (waves + lanes - 1) / lanes * lanes; }

    RowScan(const WaveReading& reading, const WaveWay& start, double step)
        : size_(padded(reading.views[start.view].phase.size())), now_(size_, 0), other_(size_, 0), twice_(size_, 0)
    {
        const WaveView& view = reading.views[start.view];
        const std::vector<double>& along = start.undone < 0 ? view.relax : view.bend;
        const std::vector<double> y = wave_phases(reading, start);
        begin(y, along.empty() ? std::vector<double>(y.size(), 0) : along, step);
    }

    /// Sum of `signs[k]` cos. \param signs padded with zeros
    [[nodiscard]] VCG_EXT_VECTORIZED double matched(const double* __restrict signs) const
    {
        const double* __restrict now = now_.data();
        double sums[lanes] = {};
        for (std::size_t k = 0; k < size_; k += lanes)
            for (int j = 0; j < lanes; ++j)
                sums[j] += signs[k + j] * now[k + j];
        return total(sums);
    }

    /// Sum of cos^2; then a step of u.
    [[nodiscard]] VCG_EXT_VECTORIZED double take()
    {
        const double* __restrict now = now_.data();
        const double* __restrict twice = twice_.data();
        double* __restrict other = other_.data();
        double sums[lanes] = {};
        for (std::size_t k = 0; k < size_; k += lanes)
            for (int j = 0; j < lanes; ++j) {
                sums[j] += now[k + j] * now[k + j];
                other[k + j] = twice[k + j] * now[k + j] - other[k + j];
            }
        now_.swap(other_);
        return total(sums);
    }

private:
    VCG_EXT_VECTORIZED void begin(const std::vector<double>& phases, const std::vector<double>& along, double step)
    {
        const double* __restrict y = phases.data();
        const double* __restrict turn = along.data();
        double* __restrict now = now_.data();
        double* __restrict other = other_.data();
        double* __restrict twice = twice_.data();
        const std::size_t count = phases.size();
        for (std::size_t k = 0; k < count; ++k) {
            double s, c, turn_s, turn_c;
            sine_cosine(2 * pi * y[k], s, c);
            sine_cosine(2 * pi * step * turn[k], turn_s, turn_c);
            now[k] = c;
            other[k] = c * turn_c + s * turn_s;
            twice[k] = 2 * turn_c;
        }
    }

    static double total(const double (&sums)[lanes])
    {
        return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
    }

    std::size_t size_;
    std::vector<double> now_, other_, twice_; ///< `other` is a step before; twice the cosine of a step
};

/// Calls `visit(part, way, S2, S1)` for all ways, S2 = sum of cos 4 pi y and S1 = sum of signs cos 2 pi y, 0 without
/// signs; one part per row, and so the same at any number of threads.
template <class Part, class Visit>
std::vector<Part> for_all_ways(const WaveReading& reading, std::vector<double> signs, const Visit& visit)
{
    const WaveGrid& grid = *reading.grid;
    const int rows = static_cast<int>(grid.rows.size());
    const int views = static_cast<int>(reading.views.size());
    const bool matches = !signs.empty();
    signs.resize(RowScan::padded(signs.size()), 0);
    std::vector<Part> parts(static_cast<std::size_t>(rows) * views);
    for_chunks(rows * views, 16, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            const WaveView& view = reading.views[i / rows];
            const WaveGrid::Row& row = grid.rows[i % rows];
            if (row.undone >= static_cast<int>(view.undone.size()) || (view.bend.empty() && row.t != 0))
                continue;
            WaveWay way{i / rows, row.undone, row.t, 0, 0};
            double& along = row.undone < 0 ? way.u : way.t;
            along = row.first;
            RowScan scan(reading, way, grid.step);
            const double n = static_cast<double>(view.phase.size());
            const double widest = view.bend.empty() ? 1e-9 : 1e9; // of shifts: none, where only the rest is asked for
            for (std::size_t j = 0; j < row.log_weight.size(); ++j) {
                const double matched = matches ? scan.matched(signs.data()) : 0;
                const double squares = scan.take();
                along = row.first + static_cast<double>(j) * grid.step;
                way.log_weight = view.log_weight + row.log_weight[j];
                if (std::abs(along) < widest)
                    visit(parts[i], way, 2 * squares - n, matched);
            }
        }
    });
    return parts;
}

void insert(std::vector<WavePresence::Found>& best, const WavePresence::Found& one)
{
    if (best.size() == WavePresence::most_kept)
        best.pop_back();
    const auto after =
        std::find_if(best.begin(), best.end(), [&](const auto& other) { return other.share < one.share; });
    best.insert(after, one);
}

/// Keeps the best, the best first; of equals the earlier.
void keep(std::vector<WavePresence::Found>& best, const WavePresence::Found& one)
{
    if (best.size() < WavePresence::most_kept || one.share > best.back().share)
        insert(best, one);
}

} // namespace

WavePresence wave_presence(const WaveReading& reading)
{
    struct Part {
        LogSum evidence;
        std::vector<WavePresence::Found> best;
    };
    const int count = static_cast<int>(reading.views.front().phase.size());
    const CosineTail& tail = cosine_tail(count);
    const auto parts = for_all_ways<Part>(reading, {}, [&](Part& part, const WaveWay& way, double gathered, double) {
        const double share = way.log_weight - tail(gathered);
        keep(part.best, {share, way});
        part.evidence.add(share);
    });
    WavePresence result;
    LogSum evidence;
    for (const Part& part : parts) {
        evidence.add(part.evidence.log());
        for (const WavePresence::Found& found : part.best)
            keep(result.best, found);
    }
    result.log_evidence = evidence.log();
    const WaveWay& way = result.best.front().way;
    double gathered = 0;
    for (const double y : wave_phases(reading, way))
        gathered += cosine(4 * pi * y);
    result.log_p = std::min(0.0, log_tail_of_cosines(count, gathered) - way.log_weight);
    return result;
}

WaveMatch wave_match(const WaveReading& reading, const WavePresence& presence, const Bits& coded)
{
    struct Part {
        double rough = never;
        WaveWay way;
        double log_weight = 0;
    };
    const int count = static_cast<int>(reading.views.front().phase.size());
    std::vector<double> signs(count);
    for (int k = 0; k < count; ++k)
        signs[k] = coded[k] ? -1 : 1;
    const CosineTail& tail = cosine_tail(count);
    auto parts = for_all_ways<Part>(reading, signs, [&](Part& part, const WaveWay& way, double gathered, double sum) {
        if (sum <= 0)
            return;
        // Hoeffding's bound, for choosing: the sum of l^2 is (n + S2) / 2. Weights add up to 1 only by the very tail
        // that the evidence was summed with.
        const double rough = -sum * sum / (count + gathered);
        const double seen = -tail(gathered) - presence.log_evidence;
        if (rough - std::max(way.log_weight, way.log_weight + seen) - 0.7 > part.rough)
            return;
        const double log_weight = way.log_weight + std::log(0.5) + log_add(0, seen);
        if (rough - log_weight < part.rough) {
            part.rough = rough - log_weight;
            part.way = way;
            part.log_weight = log_weight;
        }
    });

    constexpr std::size_t most = 3; // by a rough bound the best are the best
    const std::size_t some = std::min(most, parts.size());
    std::partial_sort(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(some), parts.end(),
                      [](const Part& a, const Part& b) { return a.rough < b.rough; });
    WaveMatch result;
    for (std::size_t i = 0; i < some && parts[i].rough < never; ++i) {
        std::vector<double> l = wave_phases(reading, parts[i].way);
        double sum = 0;
        for (int k = 0; k < count; ++k) {
            l[k] = cosine(2 * pi * l[k]);
            sum += signs[k] * l[k];
        }
        const double log_p = SignTail(l).log10_p(sum) * std::log(10.0) - parts[i].log_weight;
        if (i == 0 || log_p < result.log_p) {
            result.log_p = log_p;
            result.way = parts[i].way;
            result.sum = sum;
        }
    }
    result.log_p = std::min(0.0, result.log_p);
    return result;
}

std::vector<double> wave_soft(const std::vector<double>& phases)
{
    std::vector<double> soft(phases.size());
    double mean = 0;
    for (std::size_t k = 0; k < phases.size(); ++k) {
        soft[k] = cosine(2 * pi * phases[k]);
        mean += cosine(4 * pi * phases[k]) / static_cast<double>(phases.size());
    }
    // Normal noise takes cos 4 pi y to the fourth power of what it takes cos 2 pi y to.
    const double r = std::min(0.999, std::pow(std::max(mean, 1e-3), 0.25));
    const double concentration = r * (2 - r * r) / (1 - r * r); // of the von Mises distribution, within some percent
    for (double& l : soft)
        l *= -2 * concentration;
    return soft;
}

std::vector<WaveSoft> wave_ways(const WaveReading& reading, const WavePresence& presence, int most)
{
    std::vector<WaveSoft> ways;
    for (const auto& [share, way] : presence.best) {
        const double log_weight = share - presence.log_evidence;
        if (static_cast<int>(ways.size()) == most || log_weight <= -16)
            break;
        ways.push_back({std::exp(log_weight), wave_soft(wave_phases(reading, way))});
    }
    return ways;
}

} // namespace vcg_ext
