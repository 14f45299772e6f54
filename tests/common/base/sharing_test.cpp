#include "common/base/sharing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace swath {
namespace {

class FakeClock final : public Clock {
  public:
    Nanoseconds now() const override { return now_; }
    Nanoseconds thread_cpu() const override { return now_; }
    void advance(Nanoseconds by) { now_ += by; }

  private:
    Nanoseconds now_{0};
};

class SharingTest : public testing::Test {
  protected:
    // Plays frames of a millisecond's work, and counts those in which the team took part.
    int shared_in(int frames, Nanoseconds alone, Nanoseconds shared) {
        int count = 0;
        for (int i = 0; i < frames; ++i) {
            const bool several = sharing_.members(1e6) > 1;
            clock_.advance(several ? shared : alone);
            sharing_.done(1e6);
            count += several ? 1 : 0;
        }
        return count;
    }
    FakeClock clock_;
    ThreadTeam team_{4, clock_};
    Sharing sharing_{team_, SharingMode::kWhenItPays};
};

TEST_F(SharingTest, LeavesSmallFramesToTheCaller) {
    for (int i = 0; i < 100; ++i) {
        EXPECT_EQ(sharing_.members(20'000), 1u);
        clock_.advance(Nanoseconds(20'000));
        sharing_.done(20'000);
    }
}

TEST_F(SharingTest, WakesNoMoreMembersThanTheWorkIsWorth) {
    sharing_.members(1e6);
    clock_.advance(Nanoseconds(1'000'000));
    sharing_.done(1e6);
    EXPECT_EQ(sharing_.members(60'000), 2u);
    EXPECT_EQ(sharing_.members(1e6), 4u);
}

TEST_F(SharingTest, SharesLargeFramesWhileThatIsQuicker) {
    EXPECT_GT(shared_in(1'000, Nanoseconds(1'000'000), Nanoseconds(300'000)), 950);
}

TEST_F(SharingTest, StopsWhereTheCoresAreTakenAndTriesAgainEverMoreRarely) {
    const int first = shared_in(1'000, Nanoseconds(1'000'000), Nanoseconds(4'000'000));
    EXPECT_GE(first, 3);
    EXPECT_LE(first, 10);
    EXPECT_LE(shared_in(1'000, Nanoseconds(1'000'000), Nanoseconds(4'000'000)), 2);
}

TEST_F(SharingTest, ComesBackWhenTheCoresAreFreeAgain) {
    shared_in(200, Nanoseconds(1'000'000), Nanoseconds(4'000'000));
    shared_in(10'000, Nanoseconds(1'000'000), Nanoseconds(300'000));
    EXPECT_GT(shared_in(1'000, Nanoseconds(1'000'000), Nanoseconds(300'000)), 950);
}

TEST_F(SharingTest, IsForAllInEveryFrameWhenToldSo) {
    Sharing always(team_, SharingMode::kAlways);
    EXPECT_EQ(always.members(0), 4u);
    always.done(0);
    EXPECT_EQ(always.members(0), 4u);
}

}  // namespace
}  // namespace swath
