// SPDX-License-Identifier: GPL-3.0-or-later
#include "wave_copy.h"
#include "waves.h"

#include "../base/median.h"
#include "../base/pi.h"
#include "../carrier/wave_reading.h"
#include "../geometry/wave_values.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace vcg_ext {

namespace {

constexpr int rungs = 18; ///< each way from the usual strength: a factor of 22, so 5e-6 to 2e-3
constexpr int most_steps = 4;
constexpr double share_of_means = 0.3; ///< of all ways to read a copy: they speak louder where there is noise

/// The steps in which an embedder may have counted, those near the usual one with the most weight.
template <class Moves>
std::vector<WaveAssumption> steps_to_try(const WaveBody& body, int waves, const Moves& moves)
{
    int usual = 0;
    (void)wave_step(body, WaveReadOptions().strength, waves, &usual);
    std::vector<WaveAssumption> assumptions;
    for (int rung = usual - rungs; rung <= usual + rungs; ++rung) {
        WaveMoves one = moves(rung);
        assumptions.push_back(
            {std::abs(rung - usual) * std::log(rung_fall), std::move(one.middle), std::move(one.per_bit)});
    }
    return assumptions;
}

/// The ways in which copies of one original are read.
class Ways {
public:
    Ways() { readings.in_log_likelihoods = true; }

    /// \param weight of all of them together
    void add(std::vector<Demodulated> all, double weight)
    {
        std::stable_sort(all.begin(), all.end(),
                         [](const Demodulated& a, const Demodulated& b) { return a.weight > b.weight; });
        for (std::size_t i = 0; i < all.size() && i < most_steps && all[i].weight > 1e-3; ++i) {
            if (i == 0 && all[i].information > most_) {
                most_ = all[i].information;
                readings.blind = static_cast<int>(readings.ways.size());
            }
            Reading reading;
            reading.weight = weight * all[i].weight;
            reading.soft = std::move(all[i].soft);
            readings.ways.push_back(std::move(reading));
        }
    }

    Readings readings;

private:
    double most_ = -1;
};

/// Of what cannot be read; and of numbers of carriers on the side, as each takes as long as any other.
Readings nothing(int carriers)
{
    Readings readings;
    readings.ways.emplace_back();
    readings.ways.front().soft.assign(carriers, 0);
    return readings;
}

/// What the ways say. An original that is round about an axis has none: its equations give no numbers.
Readings readings_of(Ways ways, int carriers)
{
    return ways.readings.ways.empty() ? nothing(carriers) : std::move(ways.readings);
}

/// The patches that are there as they were, whatever noise does to all areas alike.
std::vector<int> whole_places(const LocalMeans& own, const LocalMeans& seen)
{
    constexpr double tolerance = 0.15;
    std::vector<double> ratios(own.masses.size(), 0);
    std::vector<double> there;
    for (std::size_t i = 0; i < ratios.size(); ++i) {
        ratios[i] = own.masses[i] > 0 ? seen.masses[i] / own.masses[i] : 0;
        if (ratios[i] > 0.5)
            there.push_back(ratios[i]);
    }
    std::vector<int> whole;
    if (there.empty())
        return whole;
    const double usual = median(std::move(there));
    for (std::size_t i = 0; i < ratios.size(); ++i)
        if (std::abs(ratios[i] / usual - 1) < tolerance)
            whole.push_back(static_cast<int>(i));
    return whole;
}

/// An impression's points among the waves of a plan.
class Imprint {
public:
    /// \param axes in which waves are counted
    Imprint(const Impression& impression, const Eigen::Matrix3d& axes, const WavePlan& plan)
        : impression_(impression), plan_(plan)
    {
        const Stand& solid = impression_.likeness.solid;
        for (std::size_t i = 0; i < impression_.points.size(); ++i) {
            places_.emplace_back(axes.transpose() * (impression_.points[i] - solid.centre) / solid.length);
            normals_.emplace_back(axes.transpose() * impression_.normals[i]);
        }
        const std::vector<double> values = wave_values(places_, plan.vectors, plan.phases);
        waves_ = Eigen::Map<const Rows>(values.data(), static_cast<Eigen::Index>(places_.size()), plan.count());
    }

    /// Integrals over the surface of each wave times each.
    [[nodiscard]] Eigen::MatrixXd gram() const
    {
        const Eigen::Map<const Eigen::VectorXd> areas(impression_.areas.data(), waves_.rows());
        return waves_.transpose() * (areas / std::pow(impression_.likeness.size(), 2)).asDiagonal() * waves_;
    }

    /// What waves do to the means of some patches.
    [[nodiscard]] Rows waves(const std::vector<int>& some) const
    {
        Rows result(static_cast<Eigen::Index>(some.size()), plan_.count());
        for (std::size_t row = 0; row < some.size(); ++row)
            for (int k = 0; k < plan_.count(); ++k) {
                const Point& q = plan_.vectors[k];
                const double along = q.squaredNorm() - std::pow(q.dot(normals_[some[row]]), 2);
                result(static_cast<Eigen::Index>(row), k) =
                    waves_(some[row], k) * std::exp(-mean_spread * mean_spread * along / 2);
            }
        return result;
    }

    /// How far some patches lie off where they were. Their own offsets are mean curvatures.
    [[nodiscard]] ResidualField field(const std::vector<int>& some, const LocalMeans& seen) const
    {
        const double size = impression_.likeness.size();
        const std::vector<double>& own = impression_.means.offsets;
        const auto rows = static_cast<Eigen::Index>(some.size());
        ResidualField field;
        field.floor = floor_of_noise * impression_.likeness.diagonal / size;
        field.residual.resize(rows);
        field.nuisance.resize(rows, 14);
        field.kind.assign(some.size(), 0);
        for (Eigen::Index row = 0; row < rows; ++row) {
            const int i = some[row];
            field.residual[row] = (seen.offsets[i] - own[i]) / size;
            field.places.push_back(places_[i]);
            field.roughness.push_back(std::abs(own[i]));
            auto z = field.nuisance.row(row);
            put_affine(z, places_[i], normals_[i]);
            z.tail<2>() << 1, own[i];
        }
        to_unit_rms(field.nuisance);
        return field;
    }

    /// What the local means of a copy say. \param laid on the original, its faces looking outward
    [[nodiscard]] std::vector<Demodulated> read(const Surface& laid,
                                                const std::vector<WaveAssumption>& assumptions) const
    {
        const LocalMeans seen =
            local_means(impression_.points, impression_.normals, mean_radius * impression_.likeness.size(), laid);
        const std::vector<int> whole = whole_places(impression_.means, seen);
        return demodulate(field(whole, seen), waves(whole), plan_.vectors, assumptions);
    }

private:
    const Impression& impression_;
    const WavePlan& plan_;
    Points places_;
    Points normals_;
    Rows waves_;
};

} // namespace

MarkFrame find_wave_copy(const Copy& copy, const Plan& /*plan*/)
{
    return std::make_shared<const WaveCopy>(copy);
}

Readings read_wave_copy(const Copy& copy, const Plan& plan, const MarkFrame& frame)
{
    const WaveCopy& seen = *std::get<std::shared_ptr<const WaveCopy>>(frame);
    if (plan.options.quick)
        return nothing(plan.waves.count());
    const WaveReply reply(seen.body(), plan.waves);
    const std::vector<WaveAssumption> assumptions =
        steps_to_try(seen.body(), plan.waves.count(), [&](int rung) { return reply.moves(rung); });
    Ways ways;
    const Imprint imprint(seen.impression(), seen.body().frame.axes, plan.waves);
    Surface laid = laid_by(copy.registration.affine, copy.surface, copy.registration);
    if (seen.body().frame.measure < 0)
        turn_round(laid);
    ways.add(imprint.read(laid, assumptions), share_of_means);
    for (const WaveCopy::State& state : seen.states()) {
        const Rows waves = seen.waves(state, reply.field(), plan.waves);
        ways.add(demodulate(state.field, waves, plan.waves.vectors, assumptions), (1 - share_of_means) * state.weight);
        if (state.rounds > 0)
            ways.readings.smoothing_rounds = state.rounds;
    }
    return readings_of(std::move(ways), plan.waves.count());
}

void certify_waves(const Surface& original, const Plan& plan, Certificate& certificate)
{
    const WaveBody body = wave_body(original);
    certificate.waves = Certificate::Waves{body.frame.axes, WaveReply(body, plan.waves).values()};
}

Readings read_certified_waves(const CertifiedCopy& copy, const Plan& plan)
{
    const Certificate::Waves& known = certified(copy.certificate.waves);
    const Imprint imprint(copy.certificate.impression, known.axes, plan.waves);
    const Likeness& likeness = copy.certificate.impression.likeness;
    WaveBody body;
    body.radius = likeness.size();
    body.diagonal = likeness.diagonal;
    body.area = std::pow(likeness.surface.length / body.radius, 2);
    const Eigen::PartialPivLU<Eigen::MatrixXd> derivative(imprint.gram() / (4 * pi));
    const std::vector<WaveAssumption> assumptions = steps_to_try(
        body, plan.waves.count(), [&](int rung) { return wave_moves(plan.waves, known.values, derivative, rung); });
    Ways ways;
    const Surface laid = laid_by(copy.registration.affine, copy.surface, copy.registration);
    ways.add(imprint.read(laid, assumptions), 1);
    return readings_of(std::move(ways), plan.waves.count());
}

} // namespace vcg_ext
