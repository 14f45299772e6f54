#include "common/published/cull/split_level.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "common/base/check.h"

namespace swath {
namespace {

using testing::ElementsAre;

// The levels of frames, given idle times by level.
template <class Controller>
std::vector<int> levels(Controller controller, std::vector<int> idle_by_level, int frames) {
    std::vector<int> seen;
    for (int frame = 0; frame < frames; ++frame) {
        const int level = controller.level();
        seen.push_back(level);
        controller.update(Nanoseconds(idle_by_level.at(static_cast<std::size_t>(level))));
    }
    return seen;
}

TEST(TotalIdleTime, SumsWhatMembersWaitBeforeAndAfterTheirWork) {
    const auto span = [](int start, int end) { return WorkSpan{Nanoseconds(start), Nanoseconds(end)}; };
    EXPECT_EQ(total_idle_time({}), Nanoseconds(0));
    EXPECT_EQ(total_idle_time(std::array{span(5, 9)}), Nanoseconds(0));
    EXPECT_EQ(total_idle_time(std::array{span(10, 20), span(12, 30), span(11, 13)}),
              Nanoseconds(10 + 2 + 1 + 17));
}

TEST(StartLevel, HasANodeForEveryProcessor) {
    EXPECT_EQ(start_level(1), 0);
    EXPECT_EQ(start_level(2), 1);
    EXPECT_EQ(start_level(8), 1);
    EXPECT_EQ(start_level(9), 2);
    EXPECT_EQ(start_level(64), 2);
    EXPECT_EQ(start_level(65), 3);
    EXPECT_THROW(start_level(0), CheckFailed);
}

TEST(AdsbSplitLevel, GoesDeeperWhileIdleTimeFallsAndTurnsRoundWhenItGrows) {
    // Idle times from the counts of table 3: the sum over processors of the largest count less their own.
    EXPECT_THAT(levels(AdsbSplitLevel(8), {13'299, 13'299, 3'339, 5'607, 13'323, 0, 0, 0, 0}, 10),
                ElementsAre(0, 1, 2, 3, 2, 1, 2, 3, 2, 1));
    // With those of table 2 it turns round at the first bump and never finds the best level, 3.
    EXPECT_THAT(levels(AdsbSplitLevel(8), {3'075, 3'099, 3'291, 2'519, 14'043, 0, 0, 0, 0}, 6),
                ElementsAre(0, 1, 0, 0, 0, 0));
}

TEST(AdsbSplitLevel, StaysBetweenTheRootAndTheLastLevel) {
    EXPECT_THAT(levels(AdsbSplitLevel(2), {9, 8, 7}, 6), ElementsAre(0, 1, 2, 2, 2, 2));
    EXPECT_THAT(levels(AdsbSplitLevel(0), {9}, 3), ElementsAre(0, 0, 0));
}

TEST(A2ssbSplitLevel, BeginsAtTheStartLevelAndIncreases) {
    EXPECT_THAT(levels(A2ssbSplitLevel(1, 4), {0, 9, 8, 7, 6}, 6), ElementsAre(1, 2, 3, 4, 4, 4));
}

TEST(A2ssbSplitLevel, TurnsRoundWhenIdleTimeGrowsAndMovesAtOnce) {
    EXPECT_THAT(levels(A2ssbSplitLevel(1, 5), {0, 9, 5, 7, 1, 1}, 8), ElementsAre(1, 2, 3, 2, 1, 2, 3, 2));
}

TEST(A2ssbSplitLevel, StaysBetweenTheStartLevelAndTheLast) {
    EXPECT_THAT(levels(A2ssbSplitLevel(2, 2), {0, 0, 9}, 3), ElementsAre(2, 2, 2));
    EXPECT_THAT(levels(A2ssbSplitLevel(1, 3), {0, 1, 2, 3}, 5), ElementsAre(1, 2, 1, 1, 1));
}

}  // namespace
}  // namespace swath
