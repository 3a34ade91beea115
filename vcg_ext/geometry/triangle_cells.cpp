// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangle_cells.h"

#include "../base/parallel.h"
#include "triangle_transform.h"
#include "turns.h"

#include <algorithm>
#include <array>
#include <utility>

namespace vcg_ext {

namespace {

constexpr std::size_t few = 4096; ///< triangles that need no cells
constexpr double small = 0.45;    ///< phase between the corners and the centroid of a triangle that a cell takes
constexpr double tiny = 0.12;     ///< of one for which three points are enough
constexpr double most = 3e7;      ///< cells, empty ones too
constexpr int degree = 4;         ///< of the monomials of x
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
std::vector<StoredLanes> wave_products(const WaveColumns& q)
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
    void add(const Quad& a, const Quad& b, const Quad& c, const Quad& n, bool all_tiny,
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
        if (all_tiny) {
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
void add_polynomial(const WaveColumns& q, const std::vector<StoredLanes>& powers, const Point& centre,
                    const std::array<double, products>& c, WaveSums& sums)
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

} // namespace

TriangleCells::TriangleCells(const WaveColumns& q, const Points& points, const std::vector<Triangle>& triangles,
                             double largest)
    : q_(q), points_(points), triangles_(triangles), largest_(largest), powers_(wave_products(q)),
      cell_(triangles.size(), -1)
{
    if (triangles.size() <= few)
        return;
    const double edge = size / largest;
    const Eigen::AlignedBox3d box = bounding_box(points);
    const Eigen::Array3d span = (box.sizes() / edge).array().floor() + 1;
    if (!(span.prod() < most))
        return;
    const int nx = static_cast<int>(span[0]);
    const int ny = static_cast<int>(span[1]);
    for_each_index(static_cast<int>(triangles.size()), [&](int f) {
        const Triangle& t = triangles[f];
        if (!(squared_spread(points, t, largest) < small * small))
            return;
        const Eigen::Array3d at =
            (((points[t[0]] + points[t[1]] + points[t[2]]) / 3 - box.min()) / edge).array().max(0.0).min(span - 1);
        cell_[f] = static_cast<int>(at[0]) + nx * (static_cast<int>(at[1]) + ny * static_cast<int>(at[2]));
    });
    number_cells(box, edge, span);
}

void TriangleCells::number_cells(const Eigen::AlignedBox3d& box, double edge, const Eigen::Array3d& span)
{
    const int nx = static_cast<int>(span[0]);
    const int ny = static_cast<int>(span[1]);
    std::vector<int> number(static_cast<std::size_t>(span.prod()), 0); // of triangles; then of the cell
    for (const int cell : cell_)
        if (cell >= 0)
            ++number[cell];
    first_.push_back(0);
    for (std::size_t cell = 0; cell < number.size(); ++cell)
        if (const int held = number[cell]; held > 0) {
            const int x = static_cast<int>(cell) % nx;
            const int y = static_cast<int>(cell) / nx % ny;
            const int z = static_cast<int>(cell) / nx / ny;
            number[cell] = count();
            centres_.emplace_back(box.min() + edge * Point(x + 0.5, y + 0.5, z + 0.5));
            first_.push_back(first_.back() + held);
        }
    triangle_.resize(first_.back());
    std::vector<int> next(first_.begin(), first_.end() - 1);
    for (std::size_t f = 0; f < cell_.size(); ++f)
        if (cell_[f] >= 0)
            triangle_[next[number[cell_[f]]]++] = static_cast<int>(f);
}

VCG_EXT_VECTORIZED void TriangleCells::add(int cell, WaveSums& sums) const
{
    const Point& centre = centres_[cell];
    Sources sources;
    for (int j = first_[cell]; j < first_[cell + 1]; j += lanes) {
        Quad a, b, c, n; // lanes beyond the last have no normal, and add nothing
        bool all_tiny = true;
        for (int lane = 0; lane < std::min(lanes, first_[cell + 1] - j); ++lane) {
            const Triangle& t = triangles_[triangle_[j + lane]];
            a.put(lane, points_[t[0]] - centre);
            b.put(lane, points_[t[1]] - centre);
            c.put(lane, points_[t[2]] - centre);
            n.put(lane, scaled_normal(points_, t) / 2);
            all_tiny = all_tiny && squared_spread(points_, t, largest_) < tiny * tiny;
        }
        sources.add(a, b, c, n, all_tiny, std::make_integer_sequence<int, monomials>());
    }
    add_polynomial(q_, powers_, centre, sources.polynomial(), sums);
}

} // namespace vcg_ext
