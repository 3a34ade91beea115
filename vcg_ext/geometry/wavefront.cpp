// SPDX-License-Identifier: GPL-3.0-or-later
#include "wavefront.h"

#include "../base/parallel.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

namespace vcg_ext {

namespace {

using Take = std::function<void(int step, int begin, int end)>;

/// Where blocks of consecutive vertices begin, and the end: all neighbours of a block are in it and the two beside it.
std::vector<int> blocks_of(const EdgeGraph& graph)
{
    constexpr int least = 1000; // vertices
    std::vector<int> blocks{0};
    int reach = 0; // of the blocks before the last
    for (int v = 0; v < graph.vertices(); ++v) {
        if (v < std::max(reach, blocks.back() + least))
            continue;
        for (int w = blocks.back(); w < v; ++w)
            if (graph.degree(w) > 0)
                reach = std::max(reach, graph.end(w)[-1] + 1);
        blocks.push_back(v);
    }
    blocks.push_back(graph.vertices());
    return blocks;
}

/// Takes `depth` steps from `step` on over blocks, one step a block behind the other.
/// \param ends `ends(i)`: the blocks for the step + i, first and end
template <class Ends>
void take_staggered(const std::vector<int>& blocks, int step, int depth, const Take& take, const Ends& ends)
{
    int low = std::numeric_limits<int>::max();
    int high = 0;
    for (int i = 0; i < depth; ++i) {
        low = std::min(low, ends(i).first + i);
        high = std::max(high, ends(i).second + i);
    }
    for (int j = low; j < high; ++j)
        for (int i = 0; i < depth; ++i) {
            const auto [first, end] = ends(i);
            if (const int block = j - i; block >= first && block < end)
                take(step + i, blocks[block], blocks[block + 1]);
        }
}

/// Takes `depth` steps over all blocks: first over stretches of them, each by itself, a step reaching less far than the
/// one before by a block at both ends; then over what that left out, about where stretches meet.
void take_over_stretches(const std::vector<int>& blocks, int step, int depth, int stretches, const Take& take)
{
    const int count = static_cast<int>(blocks.size()) - 1;
    const auto start = [&](int s) { return static_cast<int>(static_cast<std::int64_t>(count) * s / stretches); };
    for_chunks(stretches, 1, [&](int s, int) {
        take_staggered(blocks, step, depth, take, [&](int i) {
            return std::pair(s == 0 ? 0 : start(s) + i, s + 1 == stretches ? count : start(s + 1) - i);
        });
    });
    for_chunks(stretches - 1, 1, [&](int s, int) {
        take_staggered(blocks, step, depth, take, [&](int i) { return std::pair(start(s + 1) - i, start(s + 1) + i); });
    });
}

} // namespace

void take_steps(const EdgeGraph& graph, int first, int last, const Take& take)
{
    constexpr int most = 6;           // steps at a time
    constexpr int stretch = 5 * most; // blocks
    const std::vector<int> blocks = blocks_of(graph);
    const int stretches = static_cast<int>(blocks.size() - 1) / stretch;
    for (int step = first; step < last; step += most) {
        const int depth = std::min(most, last - step);
        if (stretches > 1)
            take_over_stretches(blocks, step, depth, stretches, take);
        else // few vertices, or numbered anyhow
            for (int i = 0; i < depth; ++i)
                for_chunks(graph.vertices(), 4096, [&](int begin, int end) { take(step + i, begin, end); });
    }
}

} // namespace vcg_ext
