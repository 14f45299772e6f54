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
    // To ask the clock is work: ends as soon as the clock has seen some of it.
    while (after == before) after = clock.thread_cpu();
    EXPECT_GT(after, before);
}

}  // namespace
}  // namespace swath
