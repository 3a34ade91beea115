// SPDX-License-Identifier: GPL-3.0-or-later
#include "weld.h"

#include "parallel.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <utility>

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

/// What is looked through by one thread for equal points; small, so that its table fits a cache.
struct Candidate {
    std::uint32_t hash;
    int point;
};

/// Sets `first` of the candidates, which come in ascending order.
void find_first(const Points& points, const Candidate* begin, const Candidate* end, std::vector<int>& first)
{
    std::size_t size = 16;
    while (size < 2 * static_cast<std::size_t>(end - begin))
        size *= 2;
    std::vector<const Candidate*> table(size, nullptr); // open addressing
    for (const Candidate* c = begin; c != end; ++c) {
        std::size_t at = c->hash & (size - 1);
        const auto differs = [&](const Candidate& other) {
            return other.hash != c->hash || points[other.point] != points[c->point];
        };
        while (table[at] && differs(*table[at]))
            at = (at + 1) & (size - 1);
        if (!table[at])
            table[at] = c;
        first[c->point] = table[at]->point;
    }
}

/// Whether all positions differ, each is in a face, and no face has one twice: what weld() would change nothing of.
bool is_welded(const std::vector<int>& first, const Surface& surface)
{
    if (!is_identity(first))
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

std::vector<int> first_equals(const Points& points)
{
    constexpr int chunk = 1 << 14;
    constexpr int bits = 9; // of the hash, for the bucket
    const int count = static_cast<int>(points.size());
    const int chunks = chunk_count(count, chunk);
    const auto bucket = [](std::uint32_t hash) { return static_cast<int>(hash >> (32 - bits)); };
    std::vector<std::uint32_t> hashes(count);
    std::vector<int> place((chunks << bits) + 1, 0); // where the next candidate goes, by bucket and chunk
    for_chunks(count, chunk, [&](int begin, int end) {
        std::vector<int> held(1 << bits, 0);
        for (int i = begin; i < end; ++i) {
            hashes[i] = static_cast<std::uint32_t>(hash(points[i]) >> 32);
            ++held[bucket(hashes[i])];
        }
        for (int b = 0; b < 1 << bits; ++b)
            place[b * chunks + begin / chunk + 1] = held[b];
    });
    std::partial_sum(place.begin(), place.end(), place.begin());
    std::vector<Candidate> candidates(count);
    for_chunks(count, chunk, [&](int begin, int end) {
        std::vector<int> next(1 << bits);
        for (int b = 0; b < 1 << bits; ++b)
            next[b] = place[b * chunks + begin / chunk];
        for (int i = begin; i < end; ++i)
            candidates[next[bucket(hashes[i])]++] = {hashes[i], i};
    });
    std::vector<int> first(count);
    for_chunks(1 << bits, 1, [&](int b, int) {
        find_first(points, candidates.data() + place[b * chunks], candidates.data() + place[(b + 1) * chunks], first);
    });
    return first;
}

bool is_identity(const std::vector<int>& numbers)
{
    return ordered_sum(static_cast<int>(numbers.size()), 0, [&](int i) { return numbers[i] != i; }) == 0;
}

Welded weld(Surface surface)
{
    const std::size_t vertices = surface.points.size();
    std::vector<int> first = first_equals(surface.points);
    if (is_welded(first, surface))
        return {std::move(surface), std::move(first)};
    Welded result;
    result.surface.triangles.reserve(surface.triangles.size());
    std::vector<int> site_of_first(vertices, -1);
    for (const Triangle& t : surface.triangles) {
        const Triangle welded = {first[t[0]], first[t[1]], first[t[2]]};
        if (welded[0] == welded[1] || welded[1] == welded[2] || welded[2] == welded[0])
            continue;
        result.surface.triangles.push_back(welded);
        for (const int v : welded)
            site_of_first[v] = 0;
    }
    for (std::size_t v = 0; v < vertices; ++v)
        if (site_of_first[v] == 0) {
            site_of_first[v] = static_cast<int>(result.surface.points.size());
            result.surface.points.push_back(surface.points[v]);
        }
    for (Triangle& t : result.surface.triangles)
        for (int& v : t)
            v = site_of_first[v];
    for (int& v : first)
        v = site_of_first[v];
    result.site_of_vertex = std::move(first);
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
