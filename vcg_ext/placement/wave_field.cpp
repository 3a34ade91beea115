// SPDX-License-Identifier: GPL-3.0-or-later
#include "wave_field.h"

#include "../base/parallel.h"
#include "../base/pi.h"
#include "../carrier/wave_flows.h"
#include "../geometry/turns.h"
#include "../geometry/wave_values.h"

#include <algorithm>
#include <cmath>

namespace vcg_ext {

namespace {

constexpr int sample = 20000; ///< sites in the Gram matrix: 64 waves need no more, and the loop corrects the rest

/// Lumped areas: a third of those around.
std::vector<double> site_areas(const WaveBody& body, const VertexFaces& around)
{
    std::vector<double> areas(body.topology.sites, 0);
    for_each_index(body.topology.sites, [&](int v) {
        for (const int* f = around.begin(v); f != around.end(v); ++f)
            areas[v] += scaled_normal(body.points, body.topology.triangles[*f]).norm() / 6;
    });
    return areas;
}

/// Means of the waves under each site's hat function, by midpoints of pieces that are small against the waves.
std::vector<double> hat_means(const WaveBody& body, const WavePlan& plan, const std::vector<double>& areas)
{
    const std::size_t count = plan.vectors.size();
    double largest = 0;
    for (const Point& q : plan.vectors)
        largest = std::max(largest, q.norm());
    std::vector<double> means(body.topology.sites * count, 0);
    for (int f = 0; f < body.topology.surface_triangles; ++f) {
        const Triangle& t = body.topology.triangles[f];
        const Point& a = body.points[t[0]];
        const Point ab = body.points[t[1]] - a;
        const Point ac = body.points[t[2]] - a;
        const double edge = std::sqrt(std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()}));
        const int n = std::clamp(static_cast<int>(std::ceil(edge * largest / 0.5)), 1, 64);
        const double area = ab.cross(ac).norm() / 2 / (n * n);
        Points middles;
        std::vector<std::array<double, 3>> hats;
        const auto add = [&](double i, double j) {
            middles.emplace_back(a + i / n * ab + j / n * ac);
            hats.push_back({1 - (i + j) / n, i / n, j / n});
        };
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
                add(i + 1.0 / 3, j + 1.0 / 3);
                if (i + j + 1 < n)
                    add(i + 2.0 / 3, j + 2.0 / 3);
            }
        const std::vector<double> waves = wave_values(middles, plan.vectors, plan.phases);
        for (std::size_t i = 0; i < middles.size(); ++i)
            for (int corner = 0; corner < 3; ++corner) {
                double* row = means.data() + t[corner] * count;
                const double share = area * hats[i][corner];
                for (std::size_t k = 0; k < count; ++k)
                    row[k] += share * waves[i * count + k];
            }
    }
    for (int v = 0; v < body.topology.sites; ++v)
        for (std::size_t k = 0; k < count; ++k)
            means[v * count + k] /= std::max(areas[v], 1e-300);
    return means;
}

} // namespace

VertexFaces faces_around(const WaveBody& body)
{
    const auto first = body.topology.triangles.begin();
    return vertex_faces(body.topology.sites, {first, first + body.topology.surface_triangles});
}

Points offset_directions(const WaveBody& body, const VertexFaces& around)
{
    constexpr double ridge = 1e-4;
    constexpr double longest = 3;
    const double outward = body.frame.measure < 0 ? -1 : 1;
    Points directions(body.topology.sites, Point::Zero());
    for_each_index(body.topology.sites, [&](int v) {
        Eigen::Matrix3d planes = Eigen::Matrix3d::Zero();
        Point sum = Point::Zero();
        for (const int* f = around.begin(v); f != around.end(v); ++f) {
            Point n = outward * scaled_normal(body.points, body.topology.triangles[*f]);
            const double doubled = n.norm();
            if (!(doubled > 0))
                continue;
            n /= doubled;
            planes += doubled * n * n.transpose();
            sum += doubled * n;
        }
        const double weight = planes.trace();
        const double length = sum.norm();
        if (!(weight > 0) || !(length > 0))
            return;
        // The ridge draws towards the mean normal, where nothing else says which way.
        const Eigen::Matrix3d m = planes + ridge * weight * Eigen::Matrix3d::Identity();
        Point u = m.ldlt().solve(sum + ridge * weight * sum / length);
        if (const double size = u.norm(); size > longest)
            u *= longest / size;
        directions[v] = u;
    });
    return directions;
}

WaveField::WaveField(const WaveBody& body, const WavePlan& plan, const VertexFaces& around) : body_(body), plan_(plan)
{
    const int sites = body.topology.sites;
    const int count = plan.count();
    const std::vector<double> areas = site_areas(body, around);
    area_ = body.area;
    // Means matter where an edge is a good part of a radian of the shortest wave.
    const double edge = std::sqrt(2 * body.area / std::max(1, body.topology.surface_triangles)) * 20;
    if (edge > 0.3 && sites <= 100000)
        values_ = hat_means(body, plan, areas);

    const int stride = (sites + sample - 1) / sample;
    double sum = 0;
    for (int v = 0; v < sites; v += stride) {
        sampled_.push_back(v);
        sum += areas[v];
    }
    for (const int v : sampled_)
        weights_.push_back(sum > 0 ? areas[v] * area_ / sum : 0);
    const std::vector<double> at = at_sites(sampled_);
    const int rows = static_cast<int>(sampled_.size());
    gram_ = ordered_fold(
        rows, Eigen::MatrixXd(Eigen::MatrixXd::Zero(count, count)),
        [&](Eigen::MatrixXd& sum, int i) {
            const Eigen::Map<const Eigen::VectorXd> w(at.data() + static_cast<std::size_t>(i) * count, count);
            sum.noalias() += (weights_[i] * w).eval() * w.transpose();
        },
        [](Eigen::MatrixXd& sum, const Eigen::MatrixXd& part) { sum += part; });
    const double ridge = 1e-6 * gram_.trace() / count;
    solver_.compute(gram_ + ridge * Eigen::MatrixXd::Identity(count, count));
}

std::vector<double> WaveField::least(const std::vector<double>& change) const
{
    const int count = plan_.count();
    const Eigen::VectorXd a = solver_.solve(4 * pi * Eigen::Map<const Eigen::VectorXd>(change.data(), count));
    const Points sites(body_.points.begin(), body_.points.begin() + body_.topology.sites);
    if (values_.empty())
        return sums_of_waves(sites, plan_.vectors, plan_.phases, {a.data(), a.data() + count});
    std::vector<double> field(sites.size());
    for_each_index(static_cast<int>(sites.size()), [&](int v) {
        double sum = 0;
        for (int k = 0; k < count; ++k)
            sum += a[k] * values_[static_cast<std::size_t>(v) * count + k];
        field[v] = sum;
    });
    return field;
}

double WaveField::size(const std::vector<double>& change) const
{
    const Eigen::VectorXd dm = 4 * pi * Eigen::Map<const Eigen::VectorXd>(change.data(), plan_.count());
    const Eigen::VectorXd a = solver_.solve(dm);
    return std::sqrt(a.dot(gram_ * a) / area_);
}

std::vector<double> WaveField::at_sites(const std::vector<int>& sites) const
{
    const std::size_t count = plan_.vectors.size();
    if (values_.empty()) {
        Points points;
        for (const int v : sites)
            points.push_back(body_.points[v]);
        return wave_values(points, plan_.vectors, plan_.phases);
    }
    std::vector<double> result;
    result.reserve(sites.size() * count);
    for (const int v : sites)
        result.insert(result.end(), values_.begin() + static_cast<std::ptrdiff_t>(v * count),
                      values_.begin() + static_cast<std::ptrdiff_t>((v + 1) * count));
    return result;
}

std::vector<double> WaveField::wave(int k) const
{
    if (fine())
        return wave_values({body_.points.begin(), body_.points.begin() + body_.topology.sites}, {plan_.vectors[k]},
                           {plan_.phases[k]});
    std::vector<double> result(body_.topology.sites);
    for (std::size_t v = 0; v < result.size(); ++v)
        result[v] = values_[v * plan_.vectors.size() + k];
    return result;
}

Eigen::MatrixXd WaveField::integrals(int rows, const std::function<Eigen::VectorXd(const Point&)>& functions) const
{
    const int count = plan_.count();
    const std::vector<double> waves = at_sites(sampled_);
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(rows, count);
    for (std::size_t i = 0; i < sampled_.size(); ++i)
        sums += weights_[i] * functions(body_.points[sampled_[i]]) *
                Eigen::Map<const Eigen::RowVectorXd>(waves.data() + i * count, count);
    return sums;
}

double WaveField::reach(int wave) const
{
    return gram_(wave, wave) / (area_ / 2);
}

} // namespace vcg_ext
