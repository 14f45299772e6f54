#include "sim/engine/event_queue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <vector>

#include "common/base/check.h"

namespace swath::sim {
namespace {

using std::chrono::nanoseconds;
using testing::ElementsAre;

TEST(EventQueue, RunsEventsByTimeAndThoseOfOneTimeAsTheyWereAskedFor) {
    EventQueue events;
    std::vector<int> order;
    events.at(nanoseconds(20), [&] { order.push_back(3); });
    events.at(nanoseconds(10), [&] { order.push_back(1); });
    events.at(nanoseconds(20), [&] { order.push_back(4); });
    events.at(nanoseconds(10), [&] { order.push_back(2); });
    events.at(nanoseconds(0), [&] { order.push_back(0); });
    events.run();
    EXPECT_THAT(order, ElementsAre(0, 1, 2, 3, 4));
    EXPECT_EQ(events.now(), nanoseconds(20));
    EXPECT_EQ(events.executed(), 5u);
}

TEST(EventQueue, RunsWhatAnEventAsksForNowAfterAllThatWasAskedForBefore) {
    EventQueue events;
    std::vector<int> order;
    events.after(nanoseconds(5), [&] {
        order.push_back(0);
        events.after(nanoseconds(0), [&] { order.push_back(2); });
        events.after(nanoseconds(1), [&] { order.push_back(3); });
    });
    events.after(nanoseconds(5), [&] { order.push_back(1); });
    events.run();
    EXPECT_THAT(order, ElementsAre(0, 1, 2, 3));
}

TEST(EventQueue, KeepsTheOrderOfManyEventsAtFewTimes) {
    EventQueue events;
    std::mt19937_64 random(1);
    struct Asked {
        nanoseconds when;
        int number;
        bool operator==(const Asked&) const = default;
    };
    std::vector<Asked> asked;
    std::vector<Asked> ran;
    const auto ask = [&](nanoseconds when) {
        const Asked event{when, static_cast<int>(asked.size())};
        asked.push_back(event);
        events.at(when, [&ran, &events, event] {
            EXPECT_EQ(events.now(), event.when);
            ran.push_back(event);
        });
    };
    for (int i = 0; i < 3000; ++i) ask(nanoseconds(random() % 100));
    // More events from within, for times from now on.
    for (int i = 0; i < 100; ++i)
        events.at(nanoseconds(i), [&] {
            for (int k = 0; k < 20; ++k) ask(events.now() + nanoseconds(random() % 100));
        });
    events.run();
    ASSERT_EQ(ran.size(), 5000u);
    std::ranges::stable_sort(asked, {}, &Asked::when);
    EXPECT_TRUE(ran == asked);
}

TEST(EventQueue, RunsTheEndOfAnInstantWhenNothingElseIsLeftToDoThen) {
    EventQueue events;
    std::vector<int> order;
    events.at(nanoseconds(7), [&] {
        events.at_end_of_instant([&] {
            order.push_back(3);
            EXPECT_EQ(events.now(), nanoseconds(7));
            events.after(nanoseconds(0), [&] { order.push_back(4); });
        });
        events.at_end_of_instant([&] { order.push_back(5); });
        events.after(nanoseconds(0), [&] { order.push_back(2); });
        order.push_back(0);
    });
    events.at(nanoseconds(7), [&] { order.push_back(1); });
    events.at(nanoseconds(8), [&] { order.push_back(6); });
    events.run();
    EXPECT_THAT(order, ElementsAre(0, 1, 2, 3, 4, 5, 6));
}

TEST(EventQueue, NeitherRunsACancelledEventNorLetsTimeStopAtIt) {
    EventQueue events;
    std::vector<int> order;
    const EventQueue::Ticket late = events.at(nanoseconds(90), [&] { order.push_back(90); });
    events.at(nanoseconds(10), [&] {
        order.push_back(10);
        events.cancel(late);
        events.cancel(late);
    });
    events.run();
    EXPECT_THAT(order, ElementsAre(10));
    EXPECT_EQ(events.now(), nanoseconds(10));
    EXPECT_EQ(events.executed(), 1u);
}

TEST(EventQueue, DoesNotCancelAnotherEventByTheTicketOfOneThatHasHappened) {
    EventQueue events;
    int ran = 0;
    const EventQueue::Ticket first = events.at(nanoseconds(1), [&] { ++ran; });
    events.run();
    events.after(nanoseconds(1), [&] { ++ran; });
    events.cancel(first);
    events.run();
    EXPECT_EQ(ran, 2);
}

TEST(EventQueue, RefusesThePastAndActionsThatCannotBeCalled) {
    EventQueue events;
    events.at(nanoseconds(10), [] {});
    events.run();
    EXPECT_THROW(events.at(nanoseconds(9), [] {}), CheckFailed);
    EXPECT_THROW(events.after(nanoseconds(-1), [] {}), CheckFailed);
    EXPECT_THROW(events.after(nanoseconds(1), nullptr), CheckFailed);
    EXPECT_NO_THROW(events.at(nanoseconds(10), [] {}));
}

TEST(EventQueue, GoesOnAfterAnActionThatThrew) {
    EventQueue events;
    bool ran = false;
    events.at(nanoseconds(1), [] { throw std::runtime_error("of the test"); });
    events.at(nanoseconds(2), [&] { ran = true; });
    EXPECT_THROW(events.run(), std::runtime_error);
    events.run();
    EXPECT_TRUE(ran);
}

}  // namespace
}  // namespace swath::sim
