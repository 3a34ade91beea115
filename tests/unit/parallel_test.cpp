#include "vcg_ext/base/parallel.h"

#include <gtest/gtest.h>
#include <stdexcept>

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

INSTANTIATE_TEST_SUITE_P(Counts, Threads, testing::Values(1, 2, 5));

} // namespace
