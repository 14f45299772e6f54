#include "common/base/clock.h"

#include <gtest/gtest.h>

namespace swath {
namespace {

TEST(SteadyClock, NeverGoesBack) {
    const SteadyClock clock;
    Nanoseconds last = clock.now();
    for (int i = 0; i < 1000; ++i) {
        const Nanoseconds now = clock.now();
        ASSERT_GE(now, last);
        last = now;
    }
}

TEST(SteadyClock, CountsTheThreadsOwnWork) {
    const SteadyClock clock;
    const Nanoseconds before = clock.thread_cpu();
    Nanoseconds after = before;
    // Ends as soon as the clock has seen any of the work that asking it is.
    while (after == before) after = clock.thread_cpu();
    EXPECT_GT(after, before);
}

}  // namespace
}  // namespace swath
