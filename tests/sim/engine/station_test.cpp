#include "sim/engine/station.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/base/check.h"

namespace swath::sim {
namespace {

using std::chrono::nanoseconds;
using testing::ElementsAre;

class StationTest : public testing::Test {
  protected:
    void submit(const std::string& name, std::int64_t duration) {
        station_.submit(nanoseconds(duration), [this, name](Nanoseconds begin, Nanoseconds end) {
            EXPECT_EQ(events_.now(), end);
            done_.push_back(name + " " + std::to_string(begin.count()) + "-" + std::to_string(end.count()));
        });
    }

    EventQueue events_;
    Station station_{events_};
    std::vector<std::string> done_;
};

TEST_F(StationTest, DoesOneJobAtATimeInTheOrderInWhichTheyCame) {
    submit("a", 30);
    submit("b", 10);
    submit("c", 20);
    EXPECT_EQ(station_.busy(), nanoseconds(60));
    events_.run();
    EXPECT_THAT(done_, ElementsAre("a 0-30", "b 30-40", "c 40-60"));
}

TEST_F(StationTest, IdlesUntilTheNextJobComes) {
    submit("a", 10);
    events_.at(nanoseconds(50), [&] { submit("b", 5); });
    events_.at(nanoseconds(52), [&] { submit("c", 5); });
    events_.run();
    EXPECT_THAT(done_, ElementsAre("a 0-10", "b 50-55", "c 55-60"));
    EXPECT_EQ(station_.busy(), nanoseconds(20));
}

TEST_F(StationTest, TakesJobsWithoutDurationInTheirTurn) {
    submit("a", 0);
    submit("b", 7);
    submit("c", 0);
    submit("d", 0);
    events_.run();
    EXPECT_THAT(done_, ElementsAre("a 0-0", "b 0-7", "c 7-7", "d 7-7"));
}

TEST_F(StationTest, BeginsAJobThatTheEndOfAnotherAsksForAfterThoseThatWait) {
    station_.submit(nanoseconds(10), [&](Nanoseconds, Nanoseconds) { submit("c", 1); });
    submit("b", 10);
    events_.run();
    EXPECT_THAT(done_, ElementsAre("b 10-20", "c 20-21"));
}

TEST_F(StationTest, RefusesANegativeDuration) { EXPECT_THROW(submit("a", -1), CheckFailed); }

}  // namespace
}  // namespace swath::sim
