// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts.h"

#include "../base/parallel.h"
#include "../base/prefetch.h"
#include "size.h"

#include <algorithm>
#include <atomic>

namespace vcg_ext {

namespace {

/// Disjoint sets of numbers that several threads join at once (Anderson and Woll 1991). Only a name that nobody has
/// joined yet is joined to a lower one, so the lowest number names a set, whoever came first.
class SharedSets {
public:
    explicit SharedSets(int count) : parent_(count)
    {
        for_each_index(count, [this](int i) { parent_[i].store(i, std::memory_order_relaxed); });
    }

    int of(int i)
    {
        for (;;) {
            const int parent = parent_[i].load(std::memory_order_relaxed);
            if (parent == i)
                return i;
            const int above = parent_[parent].load(std::memory_order_relaxed);
            parent_[i].store(above, std::memory_order_relaxed); // shortens the way, whoever else does
            i = above;
        }
    }

    void prefetch(int i) const { vcg_ext::prefetch(&parent_[i]); }

    void join(int a, int b)
    {
        for (;;) {
            a = of(a);
            b = of(b);
            if (a == b)
                return;
            int higher = std::max(a, b);
            if (parent_[higher].compare_exchange_strong(higher, std::min(a, b), std::memory_order_relaxed))
                return;
        }
    }

private:
    std::vector<std::atomic<int>> parent_;
};

} // namespace

std::vector<int> pieces_of(const Surface& surface)
{
    const int vertices = static_cast<int>(surface.points.size());
    SharedSets sets(vertices);
    for_each_index(static_cast<int>(surface.triangles.size()), [&](int f) {
        if (const std::size_t later = f + elements_ahead; later < surface.triangles.size())
            for (const int v : surface.triangles[later])
                sets.prefetch(v);
        const auto& [a, b, c] = surface.triangles[f];
        sets.join(a, b);
        sets.join(a, c);
    });
    std::vector<int> piece(vertices);
    for_each_index(vertices, [&](int v) { piece[v] = sets.of(v); });
    return piece;
}

std::vector<Part> connected_parts(const Surface& surface, int most, double least_share)
{
    const std::vector<int> piece = pieces_of(surface);
    const std::vector<double> areas = doubled_areas(surface.points, surface.triangles);
    std::vector<double> area(surface.points.size(), 0);
    double whole = 0;
    for (std::size_t f = 0; f < areas.size(); ++f) {
        area[piece[surface.triangles[f][0]]] += areas[f];
        whole += areas[f];
    }
    std::vector<int> order;
    for (std::size_t v = 0; v < area.size(); ++v)
        if (area[v] > 0 && area[v] >= least_share * whole)
            order.push_back(static_cast<int>(v));
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return area[a] > area[b]; });
    if (static_cast<int>(order.size()) > most)
        order.resize(most);

    std::vector<Part> parts(order.size());
    std::vector<int> part_of(surface.points.size(), -1);
    for (std::size_t i = 0; i < order.size(); ++i) {
        part_of[order[i]] = static_cast<int>(i);
        parts[i].area_share = area[order[i]] / whole;
    }
    std::vector<int> number(surface.points.size(), -1);
    for (std::size_t v = 0; v < surface.points.size(); ++v)
        if (const int part = part_of[piece[v]]; part >= 0) {
            number[v] = static_cast<int>(parts[part].surface.points.size());
            parts[part].surface.points.push_back(surface.points[v]);
        }
    for (const Triangle& t : surface.triangles)
        if (const int part = part_of[piece[t[0]]]; part >= 0)
            parts[part].surface.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
    return parts;
}

} // namespace vcg_ext
