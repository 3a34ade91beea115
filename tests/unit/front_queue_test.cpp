// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/geometry/front_queue.h"

#include <gtest/gtest.h>

#include <random>

using namespace vcg_ext;

namespace {

/// Beside a heap: entries come later than who went out last by up to `reach`, most of them by up to 1.
void expect_a_heap(double width, double reach)
{
    std::mt19937 draws(1);
    const auto draw = [&draws] { return static_cast<double>(draws()) / 4294967296.0; };
    FrontQueue queue(width);
    std::priority_queue<FrontQueue::Entry, std::vector<FrontQueue::Entry>, std::greater<>> heap;
    double now = 0;
    for (int i = 0; i < 20000; ++i) {
        const int more = i < 10000 ? 3 : 1; // the queue grows, then empties
        for (int k = 0; k < more - (i >= 10000); ++k) {
            const double way = draws() % 8 == 0 ? reach * draw() : draw();
            const FrontQueue::Entry entry{draws() % 8 == 0 ? now : now + way, static_cast<int>(draws() % 1000)};
            queue.push(entry.first, entry.second);
            heap.push(entry);
        }
        FrontQueue::Entry next;
        ASSERT_EQ(queue.pop(next), !heap.empty());
        if (heap.empty())
            continue;
        ASSERT_EQ(next, heap.top());
        heap.pop();
        now = next.first;
    }
    FrontQueue::Entry next;
    for (; !heap.empty(); heap.pop()) {
        ASSERT_TRUE(queue.pop(next));
        ASSERT_EQ(next, heap.top());
    }
    EXPECT_FALSE(queue.pop(next));
}

TEST(FrontQueue, GivesTheOrderOfAHeap)
{
    expect_a_heap(0.01, 1);
}

TEST(FrontQueue, HoldsTimesFarBeyondItsBuckets)
{
    expect_a_heap(0.001, 1000);
}

TEST(FrontQueue, IsAHeapWhereBucketsAreMuchTooWideOrTooNarrow)
{
    expect_a_heap(1e6, 1);
    expect_a_heap(1e-30, 1);
}

} // namespace
