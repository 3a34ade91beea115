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

/// One row of a view's grid, u by u, as complex numbers exp(2 pi i y_k) that turn by a step of u.
class RowScan {
public:
    static constexpr int lanes = 8;

    RowScan(const WaveReading& reading, const WaveWay& start, double step)
        : padded_((reading.views[start.view].phase.size() + lanes - 1) / lanes * lanes), c_(padded_, 0), s_(padded_, 0),
          turn_c_(padded_, 0), turn_s_(padded_, 0)
    {
        const WaveView& view = reading.views[start.view];
        const std::vector<double>& along = start.undone < 0 ? view.relax : view.bend;
        const std::vector<double> y = wave_phases(reading, start);
        for (std::size_t k = 0; k < y.size(); ++k) {
            sine_cosine(2 * pi * y[k], s_[k], c_[k]);
            turn_c_[k] = 1;
            if (!along.empty())
                sine_cosine(2 * pi * step * along[k], turn_s_[k], turn_c_[k]);
        }
    }

    /// Sum of cos^2, and of `signs[k]` cos; then a step of u.
    VCG_EXT_VECTORIZED void take(const double* signs, double& squares, double& matched)
    {
        double a[lanes] = {};
        double b[lanes] = {};
        double* __restrict c = c_.data();
        double* __restrict s = s_.data();
        const double* __restrict tc = turn_c_.data();
        const double* __restrict ts = turn_s_.data();
        for (std::size_t k = 0; k < padded_; k += lanes)
            for (int j = 0; j < lanes; ++j) {
                const double re = c[k + j];
                const double im = s[k + j];
                a[j] += re * re;
                b[j] += signs[k + j] * re;
                c[k + j] = re * tc[k + j] - im * ts[k + j];
                s[k + j] = re * ts[k + j] + im * tc[k + j];
            }
        squares = ((a[0] + a[1]) + (a[2] + a[3])) + ((a[4] + a[5]) + (a[6] + a[7]));
        matched = ((b[0] + b[1]) + (b[2] + b[3])) + ((b[4] + b[5]) + (b[6] + b[7]));
    }

    [[nodiscard]] std::size_t padded() const { return padded_; }

private:
    std::size_t padded_;
    std::vector<double> c_, s_, turn_c_, turn_s_;
};

/// Calls `visit(part, way, S2, S1)` for all ways, S2 = sum of cos 4 pi y and S1 = sum of signs cos 2 pi y; one part per
/// row, and so the same at any number of threads.
template <class Part, class Visit>
std::vector<Part> for_all_ways(const WaveReading& reading, const std::vector<double>& signs, const Visit& visit)
{
    const WaveGrid& grid = *reading.grid;
    const int rows = static_cast<int>(grid.rows.size());
    const int views = static_cast<int>(reading.views.size());
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
            std::vector<double> padded(signs);
            padded.resize(scan.padded(), 0);
            const double n = static_cast<double>(view.phase.size());
            const double widest = view.bend.empty() ? 1e-9 : 1e9; // of shifts: none, where only the rest is asked for
            for (std::size_t j = 0; j < row.log_weight.size(); ++j) {
                double squares, matched;
                scan.take(padded.data(), squares, matched);
                along = row.first + static_cast<double>(j) * grid.step;
                way.log_weight = view.log_weight + row.log_weight[j];
                if (std::abs(along) < widest)
                    visit(parts[i], way, 2 * squares - n, matched);
            }
        }
    });
    return parts;
}

/// Keeps the best, the best first; of equals the earlier.
void keep(std::vector<WavePresence::Found>& best, const WavePresence::Found& one)
{
    if (best.size() == WavePresence::most_kept) {
        if (!(one.share > best.back().share))
            return;
        best.pop_back();
    }
    const auto after =
        std::find_if(best.begin(), best.end(), [&](const auto& other) { return other.share < one.share; });
    best.insert(after, one);
}

} // namespace

WavePresence wave_presence(const WaveReading& reading)
{
    struct Part {
        double log_evidence = -never;
        std::vector<WavePresence::Found> best;
    };
    const int count = static_cast<int>(reading.views.front().phase.size());
    const CosineTail& tail = cosine_tail(count);
    const auto parts = for_all_ways<Part>(reading, std::vector<double>(count, 0),
                                          [&](Part& part, const WaveWay& way, double gathered, double) {
                                              const double share = way.log_weight - tail(gathered);
                                              keep(part.best, {share, way});
                                              if (share > part.log_evidence - 40)
                                                  part.log_evidence = log_add(part.log_evidence, share);
                                          });
    WavePresence result;
    result.log_evidence = -never;
    for (const Part& part : parts) {
        result.log_evidence = log_add(result.log_evidence, part.log_evidence);
        for (const WavePresence::Found& found : part.best)
            keep(result.best, found);
    }
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
