// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/base/parallel.h"
#include "vcg_ext/base/progress.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

using namespace vcg_ext;

namespace {

class Threads : public testing::TestWithParam<int> {
protected:
    void SetUp() override { set_threads(GetParam()); }
    void TearDown() override { set_threads(0); }
};

TEST_P(Threads, CoverEveryElementOnce)
{
    for (const int count : {0, 1, 99, 100, 101, 12345}) {
        std::vector<int> visits(count, 0);
        for_chunks(count, 100, [&](int begin, int end) {
            EXPECT_EQ(begin % 100, 0);
            for (int i = begin; i < end; ++i)
                ++visits[i];
        });
        EXPECT_EQ(visits, std::vector<int>(count, 1));
    }
}

TEST_P(Threads, SumInTheSameOrder)
{
    // Terms of very different size: another order of summation would show in the last bits.
    const auto term = [](int i) { return 1.0 / (1 + i) * (i % 7 == 0 ? 1e10 : 1e-6); };
    const double sum = ordered_sum(100000, 0.0, term);
    set_threads(1);
    EXPECT_EQ(sum, ordered_sum(100000, 0.0, term));
}

TEST_P(Threads, PassOnTheFirstError)
{
    try {
        for_chunks(1000, 10, [](int begin, int) {
            if (begin >= 500)
                throw std::runtime_error(std::to_string(begin));
        });
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "500");
    }
}

TEST_P(Threads, MayNest)
{
    std::vector<int> visits(40 * 1000, 0);
    for_chunks(40, 1, [&](int outer, int) {
        for_chunks(1000, 10, [&](int begin, int end) {
            for (int i = begin; i < end; ++i)
                ++visits[1000 * outer + i];
        });
    });
    EXPECT_EQ(visits, std::vector<int>(visits.size(), 1));
}

TEST_P(Threads, DoTwoThingsSideBySide)
{
    std::vector<int> first(3, 0);
    int second = 0;
    side_by_side([&] { for_chunks(3, 1, [&](int begin, int /*end*/) { first[begin] = begin; }); }, [&] { second = 7; });
    EXPECT_EQ(first, (std::vector<int>{0, 1, 2}));
    EXPECT_EQ(second, 7);
    EXPECT_THROW(side_by_side([&] { second = 8; }, [] { throw std::runtime_error("second"); }), std::runtime_error);
    EXPECT_EQ(second, 8);
}

TEST_P(Threads, MayAllAskAtOnce)
{
    std::vector<std::thread> callers;
    std::vector<double> sums(4);
    for (double& sum : sums)
        callers.emplace_back([&sum] {
            for (int i = 0; i < 100; ++i)
                sum += ordered_sum(20000, 0.0, [](int k) { return 1.0 / (1 + k); });
        });
    for (std::thread& caller : callers)
        caller.join();
    EXPECT_EQ(sums, std::vector<double>(4, sums[0]));
}

TEST_P(Threads, TellProgressFromTheCallersThread)
{
    const std::thread::id caller = std::this_thread::get_id();
    std::vector<int> percents;
    std::vector<int> visits(100050, 0);
    const auto visit = [&](int begin, int end) {
        EXPECT_EQ(begin % 100, 0);
        for (int i = begin; i < end; ++i)
            ++visits[i];
    };
    const Progress tell = [&](int percent, const char* phase) {
        EXPECT_EQ(std::this_thread::get_id(), caller);
        EXPECT_STREQ(phase, "Counting");
        percents.push_back(percent);
        return percents.size() <= 25;
    };
    for_chunks(100050, 100, tell, "Counting", visit);
    EXPECT_EQ(visits, std::vector<int>(visits.size(), 1));
    EXPECT_EQ(percents.size(), 20u);
    EXPECT_EQ(percents.front(), 0);
    EXPECT_TRUE(std::is_sorted(percents.begin(), percents.end()));
    EXPECT_LT(percents.back(), 100);
    EXPECT_THROW(for_chunks(100050, 100, tell, "Counting", visit), Cancelled);
}

TEST(Chunks, CountsEndWhereNumbersDo)
{
    constexpr int all = std::numeric_limits<int>::max();
    EXPECT_EQ(chunk_count(0, 7), 0);
    EXPECT_EQ(chunk_count(7, 7), 1);
    EXPECT_EQ(chunk_count(8, 7), 2);
    EXPECT_EQ(chunk_count(all, 1 << 30), 2);
    int last = 0;
    for_chunks(all, 1 << 30, [&](int begin, int end) {
        if (begin > 0)
            last = end;
    });
    EXPECT_EQ(last, all);
}

// Under sanitizers, limits of memory and forks of many threads are something else.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

/// Uses the threads, and says whether the sum is right.
bool sums_up()
{
    return ordered_sum(1000000, 0L, [](int i) { return static_cast<long>(i); }) == 499999500000L;
}

/// Ends the process, with 0 where the sum is right.
[[noreturn]] void sum_without_room_for_stacks()
{
    const rlimit none{1 << 20, 1 << 20};
    setrlimit(RLIMIT_AS, &none);
    set_threads(64);
    _exit(sums_up() ? 0 : 1);
}

TEST(ThreadsDeathTest, FewerDoWhereTheSystemHasNoMore)
{
    EXPECT_EXIT(sum_without_room_for_stacks(), testing::ExitedWithCode(0), "");
}

/// The same, but runs the destructors, and does not wait for ever.
[[noreturn]] void sum_and_exit()
{
    alarm(20);
    std::exit(sums_up() ? 0 : 1);
}

TEST(ThreadsDeathTest, AForkedProcessWorksAndEnds)
{
    set_threads(4);
    EXPECT_TRUE(sums_up());
    EXPECT_EXIT(sum_and_exit(), testing::ExitedWithCode(0), "");
    set_threads(0);
}

#endif

INSTANTIATE_TEST_SUITE_P(Counts, Threads, testing::Values(1, 2, 5));

} // namespace
