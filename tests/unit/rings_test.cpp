// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/geometry/rings.h"

#include "support/load.h"
#include "support/topology.h"
#include "vcg_ext/attack/reorder.h"
#include "vcg_ext/geometry/curve.h"
#include "vcg_ext/geometry/edge_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

using namespace vcg_ext;

namespace {

constexpr int unreached = std::numeric_limits<int>::max();

/// Edges from the vertex to each, by relaxing all edges until none changes anything.
std::vector<int> edges_from(const EdgeGraph& graph, int source)
{
    std::vector<int> distance(graph.vertices(), unreached);
    distance[source] = 0;
    for (bool changed = true; changed;) {
        changed = false;
        for (int v = 0; v < graph.vertices(); ++v)
            for (const int* w = graph.begin(v); w != graph.end(v); ++w)
                if (distance[*w] != unreached && distance[*w] + 1 < distance[v]) {
                    distance[v] = distance[*w] + 1;
                    changed = true;
                }
    }
    return distance;
}

TEST(Rings, ComeOneAfterTheOtherPieceByPiece)
{
    const Surface one = reorder(load("fandisk.off"), 3);
    const Surface two = joined(one, one);
    const int count = static_cast<int>(two.points.size());
    const EdgeGraph graph = edge_graph(two);
    const std::vector<int> order = ring_order(count, two.triangles);
    std::vector<int> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    std::vector<int> all(count);
    std::iota(all.begin(), all.end(), 0);
    ASSERT_EQ(sorted, all);
    for (int first = 0; first < count; first += count / 2) {
        const std::vector<int> distance = edges_from(graph, order[first]);
        for (int i = first; i < first + count / 2; ++i) {
            ASSERT_NE(distance[order[i]], unreached);
            EXPECT_GE(distance[order[i]], distance[order[std::max(first, i - 1)]]);
        }
    }
    const std::vector<int> distance = edges_from(graph, order[0]);
    const std::vector<int> near = within_rings(graph, {order[0]}, 5);
    for (int v = 0; v < count; ++v)
        EXPECT_EQ(std::binary_search(near.begin(), near.end(), v), distance[v] <= 5);
}

class Numbering : public testing::TestWithParam<void (*)(Body&)> {};

TEST_P(Numbering, LeavesTheBodyTheSame)
{
    const Surface surface = reorder(load("fandisk.off"), 3);
    Body body = body_of(surface);
    GetParam()(body);
    ASSERT_EQ(body.surface.points.size(), surface.points.size());
    for (std::size_t v = 0; v < surface.points.size(); ++v)
        EXPECT_EQ(body.surface.points[body.site_of_vertex[v]], surface.points[v]);
    std::vector<Triangle> expected = surface.triangles;
    for (Triangle& t : expected)
        for (int& v : t)
            v = body.site_of_vertex[v];
    EXPECT_NE(body.surface.triangles, expected);
    std::vector<Triangle> numbered = body.surface.triangles;
    std::sort(numbered.begin(), numbered.end());
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(numbered, expected);
}

INSTANTIATE_TEST_SUITE_P(Numberings, Numbering, testing::Values(number_by_rings, number_by_curve));

} // namespace
