// SPDX-License-Identifier: GPL-3.0-or-later
#include "wave_plan.h"

#include "../base/pi.h"
#include "../geometry/turns.h"
#include "../key/random.h"

#include <cmath>

namespace vcg_ext {

namespace {

constexpr double rungs_per_octave = 4;

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

} // namespace vcg_ext
