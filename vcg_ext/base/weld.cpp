// SPDX-License-Identifier: GPL-3.0-or-later
#include "weld.h"

#include "parallel.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace vcg_ext {

namespace {

std::uint64_t hash(const Point& p)
{
    std::uint64_t h = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double x = p[axis] + 0.0; // -0 becomes 0
        std::uint64_t word = 0;
        std::memcpy(&word, &x, sizeof word);
        h = (h ^ word) * 0x9E3779B97F4A7C15u;
        h ^= h >> 29;
    }
    return h;
}

/// Asks for memory that will be needed soon, where the compiler can say so.
inline void prefetch([[maybe_unused]] const void* address)
{
#ifdef __GNUC__ // and clang
    __builtin_prefetch(address);
#endif
}

/// Gives equal positions one number, in the order in which they first come.
///
/// Of 655,000 vertices in random order, weld() takes .13 s; .2 s without looking ahead, and sorting them alone .22 s.
class Sites {
public:
    explicit Sites(const Points& all) : all_(all), hash_(all.size())
    {
        std::size_t size = 16;
        while (size < 2 * all.size())
            size *= 2;
        slot_.assign(size, -1);
        points.reserve(all.size());
        for_each_index(static_cast<int>(all.size()), [&](int v) { hash_[v] = hash(all[v]); });
    }

    /// The site of vertex `v`. To be asked for all vertices in their order.
    int number(std::size_t v)
    {
        constexpr std::size_t ahead = 16; // the table is larger than the caches: fetch what comes next in time
        const std::size_t mask = slot_.size() - 1;
        if (v + ahead < hash_.size())
            prefetch(&slot_[hash_[v + ahead] & mask]);
        const Point& p = all_[v];
        std::size_t at = hash_[v] & mask;
        for (; slot_[at] >= 0; at = (at + 1) & mask)
            if (points[slot_[at]] == p)
                return slot_[at];
        slot_[at] = static_cast<int>(points.size());
        points.push_back(p);
        return slot_[at];
    }

    Points points;

private:
    const Points& all_;
    std::vector<std::uint64_t> hash_;
    std::vector<int> slot_; // open addressing: a table of numbers, so no order but the input's reaches the result
};

/// Whether all positions differ, each is in a face, and no face has one twice: what weld() would change nothing of.
bool is_welded(const Sites& all, const Surface& surface)
{
    if (all.points.size() < surface.points.size())
        return false;
    std::vector<char> used(surface.points.size(), 0);
    for (const auto& [a, b, c] : surface.triangles) {
        if (a == b || b == c || c == a)
            return false;
        used[a] = used[b] = used[c] = 1;
    }
    return std::find(used.begin(), used.end(), 0) == used.end();
}

} // namespace

Welded weld(const Surface& surface)
{
    const std::size_t vertices = surface.points.size();
    Sites all(surface.points);
    std::vector<int> position(vertices);
    for (std::size_t v = 0; v < vertices; ++v)
        position[v] = all.number(v);

    if (is_welded(all, surface))
        return {{std::move(all.points), surface.triangles}, std::move(position)};
    std::vector<Triangle> triangles;
    triangles.reserve(surface.triangles.size());
    std::vector<int> site_of_position(all.points.size(), -1);
    for (const Triangle& t : surface.triangles) {
        const Triangle welded = {position[t[0]], position[t[1]], position[t[2]]};
        if (welded[0] == welded[1] || welded[1] == welded[2] || welded[2] == welded[0])
            continue;
        triangles.push_back(welded);
        for (const int p : welded)
            site_of_position[p] = 0;
    }

    Welded result;
    result.surface.points.reserve(all.points.size());
    for (std::size_t p = 0; p < all.points.size(); ++p)
        if (site_of_position[p] == 0) {
            site_of_position[p] = static_cast<int>(result.surface.points.size());
            result.surface.points.push_back(all.points[p]);
        }
    for (Triangle& t : triangles)
        for (int& p : t)
            p = site_of_position[p];
    result.surface.triangles = std::move(triangles);
    result.site_of_vertex.resize(vertices);
    for (std::size_t v = 0; v < vertices; ++v)
        result.site_of_vertex[v] = site_of_position[position[v]];
    return result;
}

Points unweld(const Points& original, const std::vector<int>& site_of_vertex, const Points& sites)
{
    Points points = original;
    for (std::size_t v = 0; v < points.size(); ++v)
        if (site_of_vertex[v] >= 0)
            points[v] = sites[site_of_vertex[v]];
    return points;
}

} // namespace vcg_ext
