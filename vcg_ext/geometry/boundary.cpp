// SPDX-License-Identifier: GPL-3.0-or-later
#include "boundary.h"

#include "../base/parallel.h"

#include <cstdint>

namespace vcg_ext {

namespace {

/// The last step of splitmix64.
std::uint64_t scattered(std::uint64_t x)
{
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9U;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBU;
    return x ^ (x >> 31);
}

/// Of an edge by its direction: that of the opposite one is its negative.
std::uint64_t hash(int from, int to)
{
    const auto pair = [](int low, int high) {
        return scattered((static_cast<std::uint64_t>(low) << 32) + static_cast<std::uint64_t>(high) + 1);
    };
    return from < to ? pair(from, to) : 0 - pair(to, from);
}

/// All edges for which `wanted(use)` holds, by their lower vertex.
template <class Wanted>
std::vector<EdgeUse> edges_where(const Surface& surface, const Wanted& wanted)
{
    constexpr int chunk = 4096;
    const int vertices = static_cast<int>(surface.points.size());
    const VertexFaces around = vertex_faces(vertices, surface.triangles);
    std::vector<std::vector<EdgeUse>> found(chunk_count(vertices, chunk));
    for_chunks(vertices, chunk, [&](int begin, int end) {
        std::vector<EdgeUse> uses;
        for (int v = begin; v < end; ++v) {
            uses.clear();
            const auto use = [&](int other, int way) {
                if (other <= v)
                    return;
                for (EdgeUse& e : uses)
                    if (e.high == other) {
                        e.balance += way;
                        ++e.faces;
                        return;
                    }
                uses.push_back({v, other, way, 1});
            };
            for (const int* f = around.begin(v); f != around.end(v); ++f) {
                const Triangle& t = surface.triangles[*f];
                const int corner = t[0] == v ? 0 : t[1] == v ? 1 : 2;
                use(t[(corner + 1) % 3], 1);
                use(t[(corner + 2) % 3], -1);
            }
            for (const EdgeUse& e : uses)
                if (wanted(e))
                    found[begin / chunk].push_back(e);
        }
    });
    std::vector<EdgeUse> all;
    for (const auto& part : found)
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

} // namespace

bool is_closed_and_oriented(const Surface& surface)
{
    const std::uint64_t sum = ordered_sum(static_cast<int>(surface.triangles.size()), std::uint64_t{0}, [&](int f) {
        const auto& [a, b, c] = surface.triangles[f];
        return hash(a, b) + hash(b, c) + hash(c, a);
    });
    return sum == 0 && !surface.triangles.empty();
}

std::vector<EdgeUse> boundary(const Surface& surface)
{
    if (is_closed_and_oriented(surface))
        return {};
    return edges_where(surface, [](const EdgeUse& e) { return e.balance != 0; });
}

std::vector<EdgeUse> paired_edges(const Surface& surface)
{
    return edges_where(surface, [](const EdgeUse& e) { return e.faces == 2; });
}

} // namespace vcg_ext
