// SPDX-License-Identifier: GPL-3.0-or-later
#include "waves.h"

#include "../base/error.h"
#include "../base/parallel.h"
#include "../base/pi.h"
#include "../base/vectorized.h"
#include "../geometry/turns.h"
#include "../geometry/wave_sums.h"
#include "../key/random.h"
#include "../payload/cosine_tail.h"
#include "../payload/evidence.h"
#include "wave_spectra.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vcg_ext {

namespace {

constexpr double rungs_per_octave = 4;
constexpr double plain_share = 0.7; ///< of the weight, for the orientation that the body itself tells
constexpr double never = std::numeric_limits<double>::infinity();

/// log(exp(a) + exp(b))
double log_add(double a, double b)
{
    const double high = std::max(a, b);
    return high == -never ? high : high + std::log1p(std::exp(std::min(a, b) - high));
}

constexpr int gaps = WaveSpectra::gaps;
constexpr auto nodes = WaveSpectra::nodes;

/// Lagrange's weights at `s` of the nodes `first` to `first` + gaps.
std::array<double, gaps + 1> interpolation(double s, int first)
{
    std::array<double, gaps + 1> weights{};
    for (int i = 0; i <= gaps; ++i) {
        weights[i] = 1;
        for (int j = 0; j <= gaps; ++j)
            if (j != i)
                weights[i] *= (s - nodes[first + j]) / (nodes[first + i] - nodes[first + j]);
    }
    return weights;
}

double rms(const std::vector<double>& x)
{
    double sum = 0;
    for (const double value : x)
        sum += value * value;
    return std::sqrt(sum / std::max<std::size_t>(1, x.size()));
}

/// Scales to an RMS of half a period; nothing where the column is zero.
void to_half_a_period(std::vector<double>& column)
{
    const double size = rms(column);
    for (double& x : column)
        x *= size > 0 ? 0.5 / size : 0;
}

/// Takes off `column` what it has of `other`.
void make_square(std::vector<double>& column, const std::vector<double>& other)
{
    double dot = 0;
    double square = 0;
    for (std::size_t k = 0; k < column.size(); ++k) {
        dot += other[k] * column[k];
        square += other[k] * other[k];
    }
    if (square > 0)
        for (std::size_t k = 0; k < column.size(); ++k)
            column[k] -= dot / square * other[k];
}

/// Phases for each lambda k of `wanted`, from values at the nodes, as far as these go.
std::vector<std::vector<double>> interpolated(const std::vector<std::vector<double>>& at_nodes,
                                              const std::vector<double>& wanted, const std::vector<double>& dithers)
{
    std::vector<std::vector<double>> phases;
    for (const double s : wanted) {
        int first = 0;
        while (first + gaps + 1 < static_cast<int>(nodes.size()) && nodes[first + gaps] < s)
            first += gaps;
        if (first + gaps >= static_cast<int>(at_nodes.size()))
            break;
        const auto weights = interpolation(s, first);
        std::vector<double> phase(dithers.size());
        for (std::size_t k = 0; k < phase.size(); ++k) {
            phase[k] = -dithers[k];
            for (int i = 0; i <= gaps; ++i)
                phase[k] += weights[i] * at_nodes[first + i][k];
        }
        phases.push_back(std::move(phase));
    }
    return phases;
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

WaveGrid make_grid()
{
    constexpr double at_rest = 0.25; // it is read by itself too, and needs the least
    constexpr double shifted = 0.5;
    constexpr double undone = 0.25;
    WaveGrid grid;
    grid.step = 0.2;
    const auto take_logarithms = [&](std::size_t first_row, double share) {
        double sum = 0;
        for (std::size_t i = first_row; i < grid.rows.size(); ++i)
            for (const double weight : grid.rows[i].log_weight)
                sum += weight;
        for (std::size_t i = first_row; i < grid.rows.size(); ++i)
            for (double& weight : grid.rows[i].log_weight)
                weight = std::log(weight == 0 ? at_rest : share * weight / sum);
    };
    for (int i = -60; i <= 500; ++i) {
        WaveGrid::Row row;
        row.t = i / 10.0;
        const double reach = std::min(6.0, 1 + 1.5 * std::abs(row.t));
        const int most = static_cast<int>(reach / grid.step + 1e-9);
        row.first = -most * grid.step;
        for (int j = -most; j <= most; ++j) {
            const double u = j * grid.step;
            row.log_weight.push_back(i == 0 && j == 0 ? 0
                                                      : 1 / (1 + std::pow(std::abs(row.t) / 1.5, 1.5)) / (1 + u * u));
        }
        grid.rows.push_back(row);
    }
    take_logarithms(0, shifted);
    const std::size_t first = grid.rows.size();
    for (int i = 1; i <= 160; ++i) {
        WaveGrid::Row row;
        row.undone = i - 1;
        grid.undone.push_back(i * nodes.back() / 160);
        row.first = -2 * grid.step;
        for (int j = -2; j <= 2; ++j)
            row.log_weight.push_back((j == 0 ? 1 : 0.25) / (1 + grid.undone.back()));
        grid.rows.push_back(row);
    }
    take_logarithms(first, undone);
    return grid;
}

} // namespace

Points wave_vectors(Stream& draws, int count)
{
    Points vectors;
    while (static_cast<int>(vectors.size()) < count) {
        Point q;
        for (double& x : q)
            x = longest_wave * (2 * uniform(draws) - 1);
        const double squared = q.squaredNorm();
        if (squared >= shortest_wave * shortest_wave && squared <= longest_wave * longest_wave)
            vectors.push_back(q);
    }
    return vectors;
}

WavePlan wave_plan(const Key& key, int count)
{
    WavePlan plan;
    Stream vectors = key.stream("wave-vectors");
    plan.vectors = wave_vectors(vectors, count);
    Stream phases = key.stream("wave-phases");
    Stream dithers = key.stream("wave-dithers");
    for (int k = 0; k < count; ++k) {
        plan.phases.push_back(2 * pi * uniform(phases));
        plan.dithers.push_back(uniform(dithers));
    }
    return plan;
}

double wave_step(const WaveBody& body, double strength, int waves, int* rung)
{
    const double step = strength / usual_part * std::sqrt(12.0) * body.area * (body.diagonal / body.radius) / (4 * pi) /
                        std::sqrt(2.0 * waves);
    const int place = static_cast<int>(std::lround(rungs_per_octave * std::log2(step)));
    if (rung)
        *rung = place;
    return step_of_rung(place);
}

double step_of_rung(int rung)
{
    return std::exp2(rung / rungs_per_octave);
}

std::vector<double> wave_values_of(const std::vector<std::complex<double>>& transform,
                                   const std::vector<double>& phases, bool mirrored)
{
    std::vector<double> values(transform.size());
    for (std::size_t k = 0; k < transform.size(); ++k) {
        double s, c;
        sine_cosine(phases[k], s, c);
        values[k] = c * transform[k].real() - (mirrored ? -s : s) * transform[k].imag();
    }
    return values;
}

const WaveGrid& wave_grid()
{
    static const WaveGrid grid = make_grid();
    return grid;
}

WaveReading read_waves(WaveSpectra& spectra, const WavePlan& plan, const WaveReadOptions& options)
{
    const WaveBody& body = spectra.body();
    const int orientations = static_cast<int>(spectra.body().turns.size());
    const std::size_t count = plan.vectors.size();
    const WaveSpectra::Spectrum& rest = spectra.at_rest(plan);
    std::array<WaveSpectra::Spectrum, 2> flows;
    std::vector<const WaveSpectra::Spectrum*> before;
    if (!options.at_rest_only) {
        flows = spectra.flows(plan);
        before = spectra.unsmoothed(plan);
    }

    int own_rung = 0;
    (void)wave_step(body, options.strength, plan.count(), &own_rung);
    const int ways_round = orientations * (options.mirrored ? 2 : 1);
    double rung_sum = 0;
    for (int j = options.lowest_rung; j <= options.highest_rung; ++j)
        rung_sum += std::pow(rung_fall, std::abs(j));

    WaveReading reading;
    reading.grid = &wave_grid();
    for (int j = options.lowest_rung; j <= options.highest_rung; ++j)
        for (int way = 0; way < ways_round; ++way) {
            WaveView view;
            view.orientation = way % orientations;
            view.mirrored = way >= orientations;
            view.rung = own_rung + j;
            view.step = step_of_rung(view.rung);
            const double share = ways_round == 1 ? 1 : way == 0 ? plain_share : (1 - plain_share) / (ways_round - 1);
            view.log_weight = std::log(share * std::pow(rung_fall, std::abs(j)) / rung_sum);
            const auto part = [&](const WaveSpectra::Spectrum& all) {
                std::vector<std::complex<double>> own(count);
                for (std::size_t k = 0; k < count; ++k)
                    own[k] = all[k * orientations + view.orientation];
                std::vector<double> values = wave_values_of(own, plan.phases, view.mirrored);
                for (double& value : values)
                    value /= view.step;
                return values;
            };
            view.phase = part(rest);
            for (std::size_t k = 0; k < count; ++k)
                view.phase[k] -= plan.dithers[k];
            if (options.at_rest_only) {
                reading.views.push_back(std::move(view));
                continue;
            }
            view.bend = part(flows[0]);
            view.relax = part(flows[1]);
            to_half_a_period(view.bend);
            make_square(view.relax, view.bend);
            to_half_a_period(view.relax);
            std::vector<std::vector<double>> at_nodes;
            at_nodes.reserve(before.size());
            for (const WaveSpectra::Spectrum* spectrum : before)
                at_nodes.push_back(part(*spectrum));
            view.undone = interpolated(at_nodes, reading.grid->undone, plan.dithers);
            reading.views.push_back(std::move(view));
        }
    return reading;
}

std::vector<double> wave_phases(const WaveReading& reading, const WaveWay& way)
{
    const WaveView& view = reading.views[way.view];
    std::vector<double> y = way.undone < 0 ? view.phase : view.undone[way.undone];
    for (std::size_t k = 0; k < view.bend.size(); ++k)
        y[k] += way.t * view.bend[k] + way.u * view.relax[k];
    return y;
}

WavePresence wave_presence(const WaveReading& reading)
{
    struct Part {
        double evidence = -never;
        double best = never;
        WaveWay way;
    };
    const int count = static_cast<int>(reading.views.front().phase.size());
    const CosineTail& tail = cosine_tail(count);
    const auto parts = for_all_ways<Part>(reading, std::vector<double>(count, 0),
                                          [&](Part& part, const WaveWay& way, double gathered, double) {
                                              const double bound = tail(gathered) - way.log_weight;
                                              if (bound < part.best) {
                                                  part.best = bound;
                                                  part.way = way;
                                              }
                                              const double share = -bound;
                                              if (share > part.evidence - 40)
                                                  part.evidence = log_add(part.evidence, share);
                                          });
    WavePresence result;
    double best = never;
    result.log_evidence = -never;
    for (const Part& part : parts) {
        result.log_evidence = log_add(result.log_evidence, part.evidence);
        if (part.best < best) {
            best = part.best;
            result.way = part.way;
        }
    }
    double gathered = 0;
    for (const double y : wave_phases(reading, result.way))
        gathered += cosine(4 * pi * y);
    result.log_p = std::min(0.0, log_tail_of_cosines(count, gathered) - result.way.log_weight);
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
    struct Found {
        double log_weight = 0;
        WaveWay way;
    };
    using Part = std::vector<Found>;
    const int count = static_cast<int>(reading.views.front().phase.size());
    const CosineTail& tail = cosine_tail(count);
    const auto parts = for_all_ways<Part>(
        reading, std::vector<double>(count, 0), [&](Part& part, const WaveWay& way, double gathered, double) {
            const double log_weight = way.log_weight - tail(gathered) - presence.log_evidence;
            if (log_weight > -16)
                part.push_back({log_weight, way});
        });
    std::vector<Found> all;
    for (const Part& part : parts)
        all.insert(all.end(), part.begin(), part.end());
    std::stable_sort(all.begin(), all.end(),
                     [](const Found& a, const Found& b) { return a.log_weight > b.log_weight; });
    std::vector<WaveSoft> ways;
    for (std::size_t i = 0; i < all.size() && static_cast<int>(i) < most; ++i)
        ways.push_back({std::exp(all[i].log_weight), wave_soft(wave_phases(reading, all[i].way))});
    return ways;
}

} // namespace vcg_ext
