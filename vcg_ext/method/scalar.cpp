#include "scalar.h"

#include "../base/parallel.h"
#include "../base/progress.h"
#include "../carrier/statistic.h"
#include "../placement/histogram.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vcg_ext {

namespace {

/// A carrier this far out, as a part of alpha, is strong enough; nearer ones are pushed again.
constexpr double enough = 0.75;

/// The target of a vertex that does not move.
constexpr double stay = std::numeric_limits<double>::quiet_NaN();

/// Per carrier the vertices that it holds, in ascending order.
std::vector<std::vector<int>> members(const Carriers& carriers)
{
    std::vector<std::vector<int>> result(carriers.count);
    for (std::size_t v = 0; v < carriers.label.size(); ++v)
        if (carriers.label[v] >= 0)
            result[carriers.label[v]].push_back(static_cast<int>(v));
    return result;
}

double side(char bit)
{
    return bit ? 1 : -1;
}

/// The scalar that each vertex is to have. Carriers already beyond their targets are left alone.
std::vector<double> target_scalars(const Carriers& cover, const std::vector<double>& mobility,
                                   const std::vector<double>& targets, const std::vector<char>& bits,
                                   Statistic statistic, double guard)
{
    const std::vector<std::vector<int>> vertices = members(cover);
    const std::vector<double> now = statistics(cover, statistic);
    std::vector<double> scalars(cover.label.size(), stay);
    for_chunks(cover.count, 1, [&](int k, int) {
        if (side(bits[k]) * (now[k] - targets[k]) >= 0)
            return;
        std::vector<double> values;
        std::vector<double> mobilities;
        for (const int v : vertices[k]) {
            values.push_back(cover.value[v]);
            mobilities.push_back(mobility[v]);
        }
        const std::vector<double> mapped = map_histogram(values, statistic, targets[k], guard, mobilities);
        for (std::size_t i = 0; i < mapped.size(); ++i)
            if (mobilities[i] > 0)
                scalars[vertices[k][i]] = cover.scalar(k, mapped[i]);
    });
    return scalars;
}

} // namespace

ScalarResult embed_scalar(const ScalarMethod& method, Statistic statistic, const std::vector<char>& bits, double alpha,
                          double guard, int max_rounds, const std::function<Points(const Points&)>& round,
                          const Progress& progress)
{
    Carriers cover = method.cover;
    const double middle = threshold(statistic);
    std::vector<double> targets(cover.count);
    for (int k = 0; k < cover.count; ++k)
        targets[k] = middle + side(bits[k]) * alpha;

    const auto read_margins = [&](const Carriers& carriers) {
        std::vector<double> margins = statistics(carriers, statistic);
        for (int k = 0; k < carriers.count; ++k)
            margins[k] = side(bits[k]) * (margins[k] - middle);
        return margins;
    };
    const auto worst_of = [](const std::vector<double>& margins) {
        return *std::min_element(margins.begin(), margins.end());
    };

    ScalarResult best{{}, read_margins(cover), 0};
    if (worst_of(best.margins) >= enough * alpha) { // the mark is there already
        best.points = method.place(std::vector<double>(cover.label.size(), stay));
        return best;
    }
    double best_margin = -std::numeric_limits<double>::infinity();
    for (int r = 1; r <= max_rounds; ++r) {
        report(progress, 20 + 60 * (r - 1) / max_rounds, "Placing vertices");
        Points points = method.place(target_scalars(cover, method.mobility, targets, bits, statistic, guard));
        const Points stored = round(points);
        std::vector<double> margins = read_margins(method.read(stored));
        for (int k = 0; k < cover.count; ++k)
            if (margins[k] < enough * alpha && (r > 1 || !method.reframe))
                targets[k] = std::clamp(targets[k] + side(bits[k]) * (alpha - margins[k]), 0.02, 0.98);
        const double worst = worst_of(margins);
        if (worst > best_margin) {
            best_margin = worst;
            best.points = std::move(points);
            best.margins = std::move(margins);
        }
        best.rounds = r;
        if (best_margin >= enough * alpha)
            break;
        if (method.reframe && r == 1) // later rounds push single carriers in a frame that holds still
            cover = method.reframe(stored);
    }
    return best;
}

} // namespace vcg_ext
