// SPDX-License-Identifier: GPL-3.0-or-later
#include "impression.h"

#include "../base/check.h"
#include "../base/parallel.h"
#include "../base/pi.h"
#include "moments.h"
#include "size.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vcg_ext {

namespace {

constexpr int samples_a_point = 12;
constexpr int described = 250; ///< points that have a descriptor
constexpr double descriptor_unit = 0.01;
constexpr double offset_unit = 1e-6; ///< of the size
constexpr double octave = 24;        ///< codes for areas and masses

/// A direction as a point of the octahedron, unfolded to [-1, 1]^2, and back.
Eigen::Vector2d unfolded(const Point& n)
{
    Eigen::Vector2d u = n.head<2>() / n.lpNorm<1>();
    if (n[2] < 0)
        u = {std::copysign(1 - std::abs(u[1]), u[0]), std::copysign(1 - std::abs(u[0]), u[1])};
    return u;
}

Point folded(const Eigen::Vector2d& u)
{
    Point n(u[0], u[1], 1 - u.lpNorm<1>());
    if (n[2] < 0)
        n.head<2>() = Eigen::Vector2d(std::copysign(1 - std::abs(u[1]), u[0]), std::copysign(1 - std::abs(u[0]), u[1]));
    return n.normalized();
}

template <class Code>
Code code_of(double value)
{
    const double least = std::numeric_limits<Code>::min();
    const double most = std::numeric_limits<Code>::max();
    return static_cast<Code>(std::clamp(std::round(value), least, most));
}

/// Areas, of a unit such that they are neither much smaller nor much larger: an octave has 24 codes. 0 stays.
void write_areas(ByteWriter& writer, const std::vector<double>& areas, double unit)
{
    for (const double area : areas)
        writer.put(area > 0 ? std::max<std::uint8_t>(1, code_of<std::uint8_t>(128 + octave * std::log2(area / unit)))
                            : std::uint8_t{0});
}

std::vector<double> read_areas(ByteReader& reader, int count, double unit)
{
    std::vector<double> areas(count);
    for (double& area : areas)
        if (const int code = reader.get<std::uint8_t>(); code > 0)
            area = unit * std::exp2((code - 128) / octave);
    return areas;
}

double unit_of_areas(const Likeness& likeness)
{
    return likeness.size() * likeness.size() / 100;
}

void write(ByteWriter& writer, const Stand& stand)
{
    for (const double x : stand.centre)
        writer.put(x);
    for (const double x : stand.axes.reshaped())
        writer.put(x);
    writer.put(stand.length);
}

Stand read_stand(ByteReader& reader)
{
    Stand stand;
    for (double& x : stand.centre)
        x = reader.get<double>();
    for (double& x : stand.axes.reshaped())
        x = reader.get<double>();
    stand.length = reader.get<double>();
    return stand;
}

Impression as_stored(const Impression& impression)
{
    ByteWriter writer;
    write(writer, impression);
    ByteReader reader(writer.bytes());
    return read_impression(reader);
}

/// Points by the cube that they lie in, so that those near a place are found.
class Cubes {
public:
    /// \param r how far is looked, usually
    Cubes(const Points& points, double r) : points_(points), box_(bounding_box(points))
    {
        constexpr int most = 64; // cubes along a side
        side_ = std::max(r, box_.sizes().maxCoeff() / most);
        counts_ = (box_.sizes() / side_).array().floor().cast<int>() + 1;
        std::vector<int> cube;
        for (const Point& p : points)
            cube.push_back(number(cell(p)));
        order_.resize(points.size());
        std::iota(order_.begin(), order_.end(), 0);
        std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) { return cube[a] < cube[b]; });
        first_.assign(counts_.prod() + 1, 0);
        for (const int c : cube)
            ++first_[c + 1];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
    }

    /// Calls `found(i, squared distance)` for each point within r of p.
    template <class Found>
    void operator()(const Point& p, double r, const Found& found) const
    {
        const Eigen::Array3i low = cell(p - Point::Constant(r));
        const Eigen::Array3i high = cell(p + Point::Constant(r));
        for (int z = low[2]; z <= high[2]; ++z)
            for (int y = low[1]; y <= high[1]; ++y)
                for (int j = first_[number({low[0], y, z})]; j < first_[number({high[0], y, z}) + 1]; ++j)
                    if (const double d = (points_[order_[j]] - p).squaredNorm(); d < r * r)
                        found(order_[j], d);
    }

private:
    /// The cube of a place, or the nearest one.
    [[nodiscard]] Eigen::Array3i cell(const Point& p) const
    {
        const Eigen::Array3d along = ((p - box_.min()) / side_).array().floor();
        return along.max(0).min((counts_ - 1).cast<double>()).cast<int>();
    }

    [[nodiscard]] int number(const Eigen::Array3i& cell) const
    {
        return (cell[2] * counts_[1] + cell[1]) * counts_[0] + cell[0];
    }

    const Points& points_;
    Eigen::AlignedBox3d box_;
    double side_ = 0;
    Eigen::Array3i counts_;
    std::vector<int> order_; ///< by cube, then as they were
    std::vector<int> first_; ///< of each cube in order_
};

/// Calls `take(middle, area)` for equal pieces of a triangle, none of them longer than `longest`.
template <class Take>
void cut_up(const Points& points, const Triangle& t, double longest, const Take& take)
{
    const Point& a = points[t[0]];
    const Point ab = points[t[1]] - a;
    const Point ac = points[t[2]] - a;
    const double edge = std::sqrt(std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()}));
    const int n = std::clamp(static_cast<int>(std::ceil(edge / longest)), 1, 128);
    const double area = ab.cross(ac).norm() / 2 / (n * n);
    for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j) {
            take(Point(a + (i + 1.0 / 3) / n * ab + (j + 1.0 / 3) / n * ac), area);
            if (i + j + 1 < n)
                take(Point(a + (i + 2.0 / 3) / n * ab + (j + 2.0 / 3) / n * ac), area);
        }
}

} // namespace

LocalMeans local_means(const Points& points, const Points& normals, double r, const Surface& surface)
{
    constexpr int chunk = 16384;
    const Cubes near(points, r);
    const int faces = static_cast<int>(surface.triangles.size());
    const LocalMeans none{std::vector<double>(points.size(), 0), std::vector<double>(points.size(), 0)};
    std::vector<LocalMeans> parts(chunk_count(faces, chunk), none);
    for_chunks(faces, chunk, [&](int begin, int end) {
        LocalMeans& part = parts[begin / chunk];
        for (int f = begin; f < end; ++f) {
            const Point n = scaled_normal(surface.points, surface.triangles[f]);
            cut_up(surface.points, surface.triangles[f], r / 5, [&](const Point& p, double area) {
                near(p, r, [&](int i, double d) {
                    if (!(n.dot(normals[i]) > 0))
                        return;
                    const double u = 1 - d / (r * r);
                    part.masses[i] += u * u * area;
                    part.offsets[i] += u * u * area * (p - points[i]).dot(normals[i]);
                });
            });
        }
    });
    LocalMeans sum = none;
    for (const LocalMeans& part : parts)
        for (std::size_t i = 0; i < points.size(); ++i) {
            sum.masses[i] += part.masses[i];
            sum.offsets[i] += part.offsets[i];
        }
    for (std::size_t i = 0; i < points.size(); ++i)
        sum.offsets[i] /= sum.masses[i] > 0 ? sum.masses[i] : 1;
    return sum;
}

Impression impression_of(const Surface& surface, int count)
{
    Impression result;
    result.likeness = likeness_of(surface);
    const double outward = signed_volume(surface, result.likeness.surface.centre) < 0 ? -1 : 1;
    const SurfaceSamples samples = sample_surface(surface, samples_a_point * count, "impression");
    const Spread spread = farthest_points(samples.points, count);
    for (const int i : spread.chosen) {
        result.points.push_back(samples.points[i]);
        result.normals.emplace_back(outward * samples.normals[i]);
    }
    const Points few(result.points.begin(), result.points.begin() + std::min(described, count));
    result.likeness.features = own_features(surface, few);

    const double area_of_a_sample = surface_area(surface) / static_cast<double>(samples.points.size());
    result.areas.assign(count, 0);
    for (const int i : spread.nearest)
        result.areas[i] += area_of_a_sample;
    result.means = {std::vector<double>(count, 1), std::vector<double>(count, 0)};

    result = as_stored(result); // what follows is about the points as they are stored
    Surface out = surface;
    if (outward < 0)
        turn_round(out);
    result.means = local_means(result.points, result.normals, mean_radius * result.likeness.size(), out);
    return as_stored(result);
}

Surface scales_of(const Impression& impression)
{
    constexpr int corners = 6;
    Surface surface;
    for (std::size_t i = 0; i < impression.points.size(); ++i) {
        const Point u = impression.normals[i].unitOrthogonal();
        const Point v = impression.normals[i].cross(u);
        const double r = std::sqrt(impression.areas[i]);
        const int middle = static_cast<int>(surface.points.size());
        surface.points.push_back(impression.points[i]);
        for (int k = 0; k < corners; ++k) {
            const double angle = 2 * pi * k / corners;
            surface.points.emplace_back(impression.points[i] + r * (std::cos(angle) * u + std::sin(angle) * v));
            surface.triangles.push_back({middle, middle + 1 + k, middle + 1 + (k + 1) % corners});
        }
    }
    return surface;
}

void write(ByteWriter& writer, const Impression& impression)
{
    const Likeness& likeness = impression.likeness;
    write(writer, likeness.solid);
    write(writer, likeness.surface);
    writer.put(likeness.diagonal);
    writer.put(static_cast<std::uint16_t>(impression.points.size()));
    writer.put(static_cast<std::uint16_t>(likeness.features->points.size()));
    const Eigen::AlignedBox3d box = bounding_box(impression.points);
    const double step = box.sizes().maxCoeff() / 65535;
    for (const double x : box.min())
        writer.put(x);
    writer.put(step);
    for (const Point& p : impression.points)
        for (const double x : Point(p - box.min()))
            writer.put(code_of<std::uint16_t>(x / step));
    for (const Point& n : impression.normals)
        for (const double x : unfolded(n))
            writer.put(code_of<std::int16_t>(32767 * x));
    write_areas(writer, impression.areas, unit_of_areas(likeness));
    write_areas(writer, impression.means.masses, unit_of_areas(likeness));
    for (const double offset : impression.means.offsets)
        writer.put(code_of<std::int16_t>(offset / (offset_unit * likeness.size())));
    for (const Descriptor& descriptor : likeness.features->descriptors.front())
        for (const double x : descriptor)
            writer.put(code_of<std::int8_t>(x / descriptor_unit));
}

Impression read_impression(ByteReader& reader)
{
    Impression result;
    Likeness& likeness = result.likeness;
    likeness.solid = read_stand(reader);
    likeness.surface = read_stand(reader);
    likeness.diagonal = reader.get<double>();
    const int count = reader.get<std::uint16_t>();
    const int described_points = reader.get<std::uint16_t>();
    Point corner;
    for (double& x : corner)
        x = reader.get<double>();
    const double step = reader.get<double>();
    const bool sound =
        step > 0 && likeness.diagonal > 0 && likeness.size() > 0 && count > 0 && described_points <= count &&
        std::max({corner.cwiseAbs().maxCoeff(), step, likeness.diagonal, likeness.size()}) < largest_coordinate;
    if (!sound)
        throw Error("The numbers of the points make no sense.");
    for (int i = 0; i < count; ++i) {
        Point p;
        for (double& x : p)
            x = reader.get<std::uint16_t>();
        result.points.emplace_back(corner + step * p);
    }
    for (int i = 0; i < count; ++i) {
        Eigen::Vector2d u;
        for (double& x : u)
            x = reader.get<std::int16_t>() / 32767.0;
        result.normals.push_back(folded(u));
    }
    result.areas = read_areas(reader, count, unit_of_areas(likeness));
    result.means.masses = read_areas(reader, count, unit_of_areas(likeness));
    for (int i = 0; i < count; ++i)
        result.means.offsets.push_back(reader.get<std::int16_t>() * offset_unit * likeness.size());
    Features& features = likeness.features.emplace();
    features.points.assign(result.points.begin(), result.points.begin() + described_points);
    features.normals.assign(result.normals.begin(), result.normals.begin() + described_points);
    features.descriptors.assign(1, std::vector<Descriptor>(described_points));
    for (Descriptor& descriptor : features.descriptors.front())
        for (double& x : descriptor)
            x = descriptor_unit * reader.get<std::int8_t>();
    return result;
}

} // namespace vcg_ext
