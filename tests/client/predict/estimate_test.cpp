#include "client/predict/estimate.h"

#include <gtest/gtest.h>

namespace swath {
namespace {

TEST(RecentMedian, IsNothingBeforeTheFirstSample) { EXPECT_FALSE(RecentMedian().median()); }

TEST(RecentMedian, IsNotMovedByAFewStalls) {
    RecentMedian median;
    for (int i = 0; i < 20; ++i) median.add(i % 5 == 0 ? 1e9 : 7);
    EXPECT_EQ(median.median(), 7);
}

TEST(RecentMedian, ForgetsWhatIsOlderThanItsWindow) {
    RecentMedian median;
    for (std::size_t i = 0; i < 1000; ++i) median.add(1);
    for (std::size_t i = 0; i < RecentMedian::kWindow / 2; ++i) median.add(2);
    EXPECT_EQ(median.median(), 1);
    median.add(2);
    EXPECT_EQ(median.median(), 2);
    EXPECT_EQ(median.samples(), RecentMedian::kWindow);
}

TEST(RecentMedian, OfEvenlyManyIsTheLowerMiddle) {
    RecentMedian median;
    for (const double sample : {4, 1, 3, 2}) median.add(sample);
    EXPECT_EQ(median.median(), 2);
}

// Adds times of `each_s` a unit and `fixed_s`; every tenth one is spoilt.
void feed(RecentLine& line, double amount, double fixed_s, double each_s) {
    for (int i = 0; i < 20; ++i)
        line.add(amount * (1 + 0.001 * i), i % 10 == 3 ? 100 : fixed_s + each_s * amount * (1 + 0.001 * i));
}

TEST(RecentLine, IsNothingBeforeTheFirstPair) { EXPECT_FALSE(RecentLine().line()); }

TEST(RecentLine, IsAllForEachUnitWhileAmountsAreAlike) {
    RecentLine line;
    feed(line, 1000, 5, 0.01);
    const auto found = line.line();
    EXPECT_EQ(found->fixed_s, 0);
    EXPECT_NEAR(found->each_s, 0.015, 1e-4);
}

TEST(RecentLine, TellsThePartsByFramesThatDiffer) {
    RecentLine line;
    feed(line, 8000, 5, 0.01);
    feed(line, 1000, 5, 0.01);
    EXPECT_NEAR(line.line()->fixed_s, 5, 0.05);
    EXPECT_NEAR(line.line()->each_s, 0.01, 1e-4);
    // The line remembers it.
    for (int i = 0; i < 50; ++i) feed(line, 1000, 5, 0.01);
    EXPECT_NEAR(line.line()->fixed_s, 5, 0.05);
}

TEST(RecentLine, GoesThroughTheNewestAmountWhateverTheOthersSay) {
    RecentLine line;
    feed(line, 8000, 5, 0.01);
    feed(line, 1000, 40, 0.01);  // something else is slow now
    EXPECT_NEAR(line.line()->fixed_s + 1000 * line.line()->each_s, 50, 0.5);
}

TEST(RecentLine, HasNoFixedPartBelowNothing) {
    RecentLine steep;  // twice the work took four times as long
    feed(steep, 2000, 0, 0.04);
    feed(steep, 1000, 0, 0.02);
    EXPECT_EQ(steep.line()->fixed_s, 0);
    EXPECT_NEAR(steep.line()->each_s, 0.02, 1e-4);
}

TEST(RecentLine, TakesAtMostHalfOfTheTimeForFixed) {
    RecentLine falling;  // half of the work took twice the time
    feed(falling, 2000, 10, 0);
    feed(falling, 1000, 20, 0);
    EXPECT_NEAR(falling.line()->fixed_s, 10, 0.2);
    EXPECT_NEAR(falling.line()->each_s, 0.01, 2e-4);
}

TEST(RecentLine, ForgetsAmountsThatHaveNotBeenSeenForLong) {
    RecentLine line;
    feed(line, 8000, 5, 0.01);
    for (int i = 0; i < 101; ++i) feed(line, 1000, 5, 0.01);
    EXPECT_EQ(line.line()->fixed_s, 0);
}

TEST(RecentLine, IsCopiedAsAValue) {
    RecentLine copy;
    {
        RecentLine line;
        feed(line, 1000, 0, 0.01);
        copy = line;
    }
    feed(copy, 1000, 0, 0.01);
    EXPECT_NEAR(copy.line()->each_s, 0.01, 1e-4);
}

}  // namespace
}  // namespace swath
