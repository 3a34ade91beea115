// SPDX-License-Identifier: GPL-3.0-or-later
#include "wave_sums.h"

#include "../base/parallel.h"
#include "../base/pi.h"
#include "../base/vectorized.h"
#include "turns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace vcg_ext {

namespace {

/// Waves as columns, so that loops over them vectorise.
struct Columns {
    std::vector<double> x, y, z; // radians per unit
    std::size_t count = 0;

    explicit Columns(const Points& waves) : x(waves.size()), y(waves.size()), z(waves.size()), count(waves.size())
    {
        for (std::size_t k = 0; k < count; ++k) {
            x[k] = waves[k][0];
            y[k] = waves[k][1];
            z[k] = waves[k][2];
        }
    }
};

/// What a run of triangles comes to.
struct PartialSums {
    std::vector<double> re, im;
};

/// Adds (q . n) times the mean of exp(i q . x) over a triangle, for all waves, by the series of `Terms` homogeneous
/// polynomials about the centroid: 2 h_n / (n + 2)!, where h_n = -e2 h_(n-2) + e3 h_(n-3), since h_1 is 0.
template <int Terms>
void add_series(const Columns& q, const Point& centre, const Point& to_a, const Point& to_b, const Point& n,
                PartialSums& sums)
{
    const double* __restrict qx = q.x.data();
    const double* __restrict qy = q.y.data();
    const double* __restrict qz = q.z.data();
    double* __restrict re = sums.re.data();
    double* __restrict im = sums.im.data();
    const double cx = centre[0], cy = centre[1], cz = centre[2];
    const double ax = to_a[0], ay = to_a[1], az = to_a[2];
    const double bx = to_b[0], by = to_b[1], bz = to_b[2];
    const double nx = n[0], ny = n[1], nz = n[2];
    for (std::size_t k = 0; k < q.count; ++k) {
        double s, c;
        sine_cosine(qx[k] * cx + qy[k] * cy + qz[k] * cz, s, c);
        const double a = qx[k] * ax + qy[k] * ay + qz[k] * az;
        const double b = qx[k] * bx + qy[k] * by + qz[k] * bz;
        const double g = qx[k] * nx + qy[k] * ny + qz[k] * nz;
        const double sum = a + b;
        const double e2 = a * b - sum * sum;
        const double e3 = -a * b * sum;
        double h0 = 1, h1 = 0, h2 = -e2;
        double real = 1 + e2 * (1.0 / 12), imaginary = 0;
        double factor = 1.0 / 12; // 2 / (n + 2)!
        for (int m = 3; m < Terms; ++m) {
            const double h = e3 * h0 - e2 * h1;
            factor /= m + 2;
            if (m % 4 == 0)
                real += factor * h;
            else if (m % 4 == 1)
                imaginary += factor * h;
            else if (m % 4 == 2)
                real -= factor * h;
            else
                imaginary -= factor * h;
            h0 = h1;
            h1 = h2;
            h2 = h;
        }
        re[k] += g * (real * c - imaginary * s);
        im[k] += g * (real * s + imaginary * c);
    }
}

double sinc(double x)
{
    return std::abs(x) < 1e-4 ? 1 - x * x / 6 : sine(x) / x;
}

/// First divided difference of exp(i t).
std::complex<double> divided(double a, double b)
{
    double s, c;
    sine_cosine((a + b) / 2, s, c);
    return sinc((a - b) / 2) * std::complex<double>(c, s);
}

/// The same for a triangle of any size: by divided differences over the pair of corners that lies farthest apart.
void add_exact(const Columns& q, const Point& centre, const Point& to_a, const Point& to_b, const Point& n,
               PartialSums& sums)
{
    for (std::size_t k = 0; k < q.count; ++k) {
        const Point wave(q.x[k], q.y[k], q.z[k]);
        double t[3] = {wave.dot(to_a), wave.dot(to_b), 0};
        t[2] = -t[0] - t[1];
        if (std::max({std::abs(t[0]), std::abs(t[1]), std::abs(t[2])}) <= 2)
            continue; // add_series' part
        std::sort(t, t + 3);
        const std::complex<double> difference = (divided(t[2], t[1]) - divided(t[1], t[0])) / (t[2] - t[0]);
        double s, c;
        sine_cosine(wave.dot(centre), s, c);
        // exp[a, b, c] with respect to i t: one more 1 / i
        const std::complex<double> mean =
            2.0 * std::complex<double>(difference.imag(), -difference.real()) * std::complex<double>(c, s);
        sums.re[k] += wave.dot(n) * mean.real();
        sums.im[k] += wave.dot(n) * mean.imag();
    }
}

/// The series for those waves only whose phases lie close together.
void add_mixed(const Columns& q, const Point& centre, const Point& to_a, const Point& to_b, const Point& n,
               PartialSums& sums)
{
    Points close;
    std::vector<std::size_t> which;
    for (std::size_t k = 0; k < q.count; ++k) {
        const Point wave(q.x[k], q.y[k], q.z[k]);
        const double a = wave.dot(to_a);
        const double b = wave.dot(to_b);
        if (std::max({std::abs(a), std::abs(b), std::abs(a + b)}) <= 2) {
            close.push_back(wave);
            which.push_back(k);
        }
    }
    PartialSums part{std::vector<double>(close.size(), 0), std::vector<double>(close.size(), 0)};
    add_series<22>(Columns(close), centre, to_a, to_b, n, part);
    for (std::size_t i = 0; i < which.size(); ++i) {
        sums.re[which[i]] += part.re[i];
        sums.im[which[i]] += part.im[i];
    }
    add_exact(q, centre, to_a, to_b, n, sums);
}

/// Small triangles of a cell together: sum of (q . n) exp(i q . x) about the cell's centre as a polynomial of q up to
/// the fifth degree. Of |q . x| it takes at most .7 and a triangle, usually .3: the rest is below 1e-4 of a cell.
namespace cells {

constexpr int degree = 4; ///< of the monomials of x
constexpr int monomials = 35;
constexpr int products = 55; ///< monomials of q from degree 1 to 5
constexpr double size = 0.8; ///< edge of a cell over the shortest wave's 1 / |q|

struct Exponents {
    int x = 0, y = 0, z = 0;
};

template <int Low, int High, int Count>
constexpr std::array<Exponents, Count> exponents()
{
    std::array<Exponents, Count> list{};
    int n = 0;
    for (int total = Low; total <= High; ++total)
        for (int x = total; x >= 0; --x)
            for (int y = total - x; y >= 0; --y)
                list[n++] = {x, y, total - x - y};
    return list;
}

constexpr auto of_x = exponents<0, degree, monomials>();
constexpr auto of_q = exponents<1, degree + 1, products>();

constexpr int place(int x, int y, int z)
{
    for (int i = 0; i < products; ++i)
        if (of_q[i].x == x && of_q[i].y == y && of_q[i].z == z)
            return i;
    return -1;
}

/// Which product a monomial and a component of the normal make, and by what factor: i^|b| / b!, without the i of odd
/// degrees.
struct Table {
    std::array<std::array<int, 3>, monomials> product{};
    std::array<double, monomials> factor{};

    constexpr Table()
    {
        for (int m = 0; m < monomials; ++m) {
            const Exponents& b = of_x[m];
            product[m] = {place(b.x + 1, b.y, b.z), place(b.x, b.y + 1, b.z), place(b.x, b.y, b.z + 1)};
            double f = (b.x + b.y + b.z) / 2 % 2 == 0 ? 1 : -1;
            for (const int e : {b.x, b.y, b.z})
                for (int i = 2; i <= e; ++i)
                    f /= i;
            factor[m] = f;
        }
    }
};

constexpr Table table;

/// Products of each group of waves: [group][product].
std::vector<StoredLanes> wave_products(const Columns& q)
{
    const std::size_t groups = (q.count + lanes - 1) / lanes;
    std::vector<StoredLanes> result(groups * products, StoredLanes{});
    for (std::size_t k = 0; k < q.count; ++k) {
        double power[3][degree + 2];
        for (int axis = 0; axis < 3; ++axis) {
            power[axis][0] = 1;
            const double base = axis == 0 ? q.x[k] : axis == 1 ? q.y[k] : q.z[k];
            for (int e = 1; e <= degree + 1; ++e)
                power[axis][e] = power[axis][e - 1] * base;
        }
        for (int i = 0; i < products; ++i)
            result[k / lanes * products + i].value[k % lanes] =
                power[0][of_q[i].x] * power[1][of_q[i].y] * power[2][of_q[i].z];
    }
    return result;
}

/// As many points as there are lanes.
struct Quad {
    Lanes of[3] = {};

    void put(int lane, const Point& p)
    {
        for (int axis = 0; axis < 3; ++axis)
            of[axis][lane] = p[axis];
    }
};

/// A cell's monomials, summed with the components of the normals; a lane sums each fourth triangle.
struct Sources {
    std::array<StoredLanes, monomials> by_normal[3] = {};

    /// Adds triangles: monomials by a rule that is exact to the second degree (three points) or the fourth (six).
    template <int... m>
    void add(const Quad& a, const Quad& b, const Quad& c, const Quad& n, bool tiny,
             std::integer_sequence<int, m...> /*all monomials: as constants, so that powers are no look-ups*/)
    {
        std::array<StoredLanes, monomials> mean{};
        const auto point = [&](double of_a, double of_b, double of_c, double weight) {
            Lanes power[3][degree + 1];
            for (int axis = 0; axis < 3; ++axis) {
                const Lanes p = of_a * a.of[axis] + of_b * b.of[axis] + of_c * c.of[axis];
                power[axis][0] = Lanes{} + 1;
                for (int e = 1; e <= degree; ++e)
                    power[axis][e] = power[axis][e - 1] * p;
            }
            ((mean[m].value += weight * (power[0][of_x[m].x] * power[1][of_x[m].y] * power[2][of_x[m].z])), ...);
        };
        const auto three = [&](double far, double near, double weight) {
            point(far, near, near, weight);
            point(near, far, near, weight);
            point(near, near, far, weight);
        };
        if (tiny) {
            three(0, 0.5, 1.0 / 3);
        } else { // Dunavant's rule of degree 4
            three(0.108103018168070, 0.445948490915965, 0.223381589678011);
            three(0.816847572980459, 0.091576213509771, 0.109951743655322);
        }
        for (int axis = 0; axis < 3; ++axis)
            ((by_normal[axis][m].value += n.of[axis] * mean[m].value), ...);
    }

    [[nodiscard]] std::array<double, products> polynomial() const
    {
        std::array<double, products> c{};
        for (int m = 0; m < monomials; ++m)
            for (int axis = 0; axis < 3; ++axis) {
                const Lanes& sum = by_normal[axis][m].value;
                c[table.product[m][axis]] += table.factor[m] * (sum[0] + sum[1] + sum[2] + sum[3]);
            }
        return c;
    }
};

/// Adds exp(i q . centre) times the polynomial, for all waves.
void add(const Columns& q, const std::vector<StoredLanes>& powers, const Point& centre,
         const std::array<double, products>& c, PartialSums& sums)
{
    for (std::size_t first = 0; first < q.count; first += lanes) {
        const StoredLanes* power = powers.data() + first / lanes * products;
        Lanes real{};
        Lanes imaginary{};
        const auto take = [&](Lanes& to, int begin, int end) {
            for (int i = begin; i < end; ++i)
                to += c[i] * power[i].value;
        };
        take(real, 0, 3); // degrees 1, 3 and 5 of q are even ones of x
        take(imaginary, 3, 9);
        take(real, 9, 19);
        take(imaginary, 19, 34);
        take(real, 34, 55);
        const std::size_t count = std::min<std::size_t>(lanes, q.count - first);
        for (std::size_t j = 0; j < count; ++j) {
            double s, co;
            sine_cosine(q.x[first + j] * centre[0] + q.y[first + j] * centre[1] + q.z[first + j] * centre[2], s, co);
            sums.re[first + j] += real[j] * co - imaginary[j] * s;
            sums.im[first + j] += real[j] * s + imaginary[j] * co;
        }
    }
}

/// Triangles by the cell that holds their centroid: those of cell i are `triangle[first[i]]` on, in ascending order.
struct Grid {
    Points centres;
    std::vector<int> first;
    std::vector<int> triangle;
};

/// \param own -1 for triangles that no cell may take; on return the cell's number
Grid sort(const Points& points, const std::vector<Triangle>& triangles, double edge, std::vector<int>& own)
{
    const int count = static_cast<int>(triangles.size());
    const Eigen::AlignedBox3d box = bounding_box(points);
    Grid grid;
    const Eigen::Array3d span = (box.sizes() / edge).array().floor() + 1;
    if (!(span.prod() < 3e7)) {
        std::fill(own.begin(), own.end(), -1);
        return grid;
    }
    const int nx = static_cast<int>(span[0]);
    const int ny = static_cast<int>(span[1]);
    for_each_index(count, [&](int f) {
        if (own[f] < 0)
            return;
        const Triangle& t = triangles[f];
        const Eigen::Array3d at =
            (((points[t[0]] + points[t[1]] + points[t[2]]) / 3 - box.min()) / edge).array().max(0.0).min(span - 1);
        own[f] = static_cast<int>(at[0]) + nx * (static_cast<int>(at[1]) + ny * static_cast<int>(at[2]));
    });
    std::vector<int> number(static_cast<std::size_t>(span.prod()), 0);
    for (const int cell : own)
        if (cell >= 0)
            ++number[cell];
    grid.first.push_back(0);
    for (std::size_t cell = 0; cell < number.size(); ++cell)
        if (const int size_here = number[cell]; size_here > 0) {
            const int x = static_cast<int>(cell) % nx;
            const int y = static_cast<int>(cell) / nx % ny;
            const int z = static_cast<int>(cell) / nx / ny;
            grid.centres.emplace_back(box.min() + edge * Point(x + 0.5, y + 0.5, z + 0.5));
            number[cell] = static_cast<int>(grid.centres.size()) - 1;
            grid.first.push_back(grid.first.back() + size_here);
        }
    grid.triangle.resize(grid.first.back());
    std::vector<int> next(grid.first.begin(), grid.first.end() - 1);
    for (int f = 0; f < count; ++f)
        if (own[f] >= 0)
            grid.triangle[next[number[own[f]]]++] = f;
    return grid;
}

} // namespace cells

/// Greatest squared phase between a triangle's centroid and a corner.
double squared_spread(const Points& points, const Triangle& t, double largest)
{
    const Point centre = (points[t[0]] + points[t[1]] + points[t[2]]) / 3;
    return largest * largest *
           std::max({(points[t[0]] - centre).squaredNorm(), (points[t[1]] - centre).squaredNorm(),
                     (points[t[2]] - centre).squaredNorm()});
}

VCG_EXT_VECTORIZED void add_triangle(const Columns& q, const Points& points, const Triangle& t, double spread,
                                     PartialSums& sums)
{
    const Point centre = (points[t[0]] + points[t[1]] + points[t[2]]) / 3;
    const Point a = points[t[0]] - centre;
    const Point b = points[t[1]] - centre;
    const Point n = scaled_normal(points, t) / 2;
    if (spread < 0.1)
        add_series<5>(q, centre, a, b, n, sums);
    else if (spread < 0.5)
        add_series<9>(q, centre, a, b, n, sums);
    else if (spread < 2)
        add_series<16>(q, centre, a, b, n, sums);
    else
        add_mixed(q, centre, a, b, n, sums);
}

/// Adds the cell's small triangles, all of them together.
VCG_EXT_VECTORIZED void add_cell(const Columns& q, const std::vector<StoredLanes>& powers, const Points& points,
                                 const std::vector<Triangle>& triangles, const cells::Grid& grid, int cell,
                                 double largest, PartialSums& sums)
{
    const Point& centre = grid.centres[cell];
    cells::Sources sources;
    for (int j = grid.first[cell]; j < grid.first[cell + 1]; j += lanes) {
        cells::Quad a, b, c, n; // lanes beyond the last have no normal, and add nothing
        bool tiny = true;
        for (int lane = 0; lane < std::min(lanes, grid.first[cell + 1] - j); ++lane) {
            const Triangle& t = triangles[grid.triangle[j + lane]];
            a.put(lane, points[t[0]] - centre);
            b.put(lane, points[t[1]] - centre);
            c.put(lane, points[t[2]] - centre);
            n.put(lane, scaled_normal(points, t) / 2);
            tiny = tiny && squared_spread(points, t, largest) < 0.12 * 0.12;
        }
        sources.add(a, b, c, n, tiny, std::make_integer_sequence<int, cells::monomials>());
    }
    cells::add(q, powers, centre, sources.polynomial(), sums);
}

/// cos(q . p + phase), for all waves.
VCG_EXT_VECTORIZED void cosines(const Columns& q, const double* __restrict phase, const Point& p,
                                double* __restrict out)
{
    const double* __restrict qx = q.x.data();
    const double* __restrict qy = q.y.data();
    const double* __restrict qz = q.z.data();
    const double x = p[0], y = p[1], z = p[2];
    for (std::size_t k = 0; k < q.count; ++k) {
        double s, c;
        sine_cosine(qx[k] * x + qy[k] * y + qz[k] * z + phase[k], s, c);
        out[k] = c;
    }
}

} // namespace

std::vector<std::complex<double>> solid_transform(const Points& points, const std::vector<Triangle>& triangles,
                                                  const Points& waves, double longest)
{
    constexpr int chunk = 1024;
    constexpr int cells_chunk = 64;
    const int count = static_cast<int>(triangles.size());
    const Columns q(waves);
    double largest = longest;
    for (const Point& wave : waves)
        largest = std::max(largest, wave.norm());

    std::vector<int> own(count);
    for_each_index(count,
                   [&](int f) { own[f] = squared_spread(points, triangles[f], largest) < 0.45 * 0.45 ? 0 : -1; });
    cells::Grid grid;
    if (count > 4096)
        grid = cells::sort(points, triangles, cells::size / largest, own);
    else
        std::fill(own.begin(), own.end(), -1);
    const std::vector<StoredLanes> powers = cells::wave_products(q);
    const int cell_count = static_cast<int>(grid.centres.size());
    const int triangle_parts = (count + chunk - 1) / chunk;
    const int cell_parts = (cell_count + cells_chunk - 1) / cells_chunk;

    std::vector<PartialSums> partial(triangle_parts + cell_parts);
    const auto nothing = [&] { return PartialSums{std::vector<double>(q.count, 0), std::vector<double>(q.count, 0)}; };
    for_chunks(count, chunk, [&](int begin, int end) {
        PartialSums sums = nothing();
        for (int f = begin; f < end; ++f)
            if (own[f] < 0)
                add_triangle(q, points, triangles[f], std::sqrt(squared_spread(points, triangles[f], largest)), sums);
        partial[begin / chunk] = std::move(sums);
    });
    for_chunks(cell_count, cells_chunk, [&](int begin, int end) {
        PartialSums sums = nothing();
        for (int i = begin; i < end; ++i)
            add_cell(q, powers, points, triangles, grid, i, largest, sums);
        partial[triangle_parts + begin / cells_chunk] = std::move(sums);
    });

    std::vector<std::complex<double>> result(q.count);
    for (std::size_t k = 0; k < q.count; ++k) {
        double re = 0, im = 0;
        for (const PartialSums& part : partial) {
            re += part.re[k];
            im += part.im[k];
        }
        result[k] = std::complex<double>(im, -re) / (4 * pi * waves[k].squaredNorm());
    }
    return result;
}

std::vector<double> wave_values(const Points& points, const Points& waves, const std::vector<double>& phases)
{
    const Columns q(waves);
    std::vector<double> values(points.size() * q.count);
    for_chunks(static_cast<int>(points.size()), 1024, [&](int begin, int end) {
        for (int v = begin; v < end; ++v)
            cosines(q, phases.data(), points[v], values.data() + v * q.count);
    });
    return values;
}

std::vector<double> wave_field(const Points& points, const Points& waves, const std::vector<double>& phases,
                               const std::vector<double>& amplitudes)
{
    const Columns q(waves);
    std::vector<double> field(points.size());
    for_chunks(static_cast<int>(points.size()), 1024, [&](int begin, int end) {
        std::vector<double> values(q.count);
        for (int v = begin; v < end; ++v) {
            cosines(q, phases.data(), points[v], values.data());
            double sum = 0;
            for (std::size_t k = 0; k < q.count; ++k)
                sum += amplitudes[k] * values[k];
            field[v] = sum;
        }
    });
    return field;
}

} // namespace vcg_ext
