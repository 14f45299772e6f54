#include "sim/engine/stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "common/base/check.h"
#include "tests/sim/engine/flows.h"

namespace swath::sim {
namespace {

using std::chrono::nanoseconds;
using test::hosts;
using testing::ElementsAre;

TEST(Stream, LetsTheLatencyPassBeforeTheFirstByteFlows) {
    // The second message shares from 400 to 600, when it ends; the first then has 700 of its bytes to go.
    EXPECT_THAT(test::arrivals(hosts(3), {{0, 2, 900, nanoseconds(0)}, {1, 2, 100, nanoseconds(100)}},
                               nanoseconds(300)),
                ElementsAre(nanoseconds(1300), nanoseconds(600)));
}

TEST(Stream, TakesTheLatencyAloneForNoBytesAndForOneself) {
    EXPECT_THAT(test::arrivals(hosts(2), {{0, 1, 0, {}}, {1, 1, 1e9, {}}, {0, 1, 100, {}}}, nanoseconds(70)),
                ElementsAre(nanoseconds(70), nanoseconds(70), nanoseconds(170)));
}

TEST(Stream, DeliversMessagesOneAfterAnotherWithOneLatencyForAll) {
    EventQueue events;
    FlowNetwork network(events, hosts(2));
    Stream stream(events, network, nanoseconds(50), 0, 1);
    std::string order;
    std::vector<Nanoseconds> times;
    for (const auto& [name, bytes] : {std::pair{'a', 1000.}, {'b', 1.}, {'c', 0.}, {'d', 99.}})
        stream.send(bytes, [&, n = name] {
            order += n;
            times.push_back(events.now());
        });
    events.run();
    EXPECT_EQ(order, "abcd");
    EXPECT_THAT(times,
                ElementsAre(nanoseconds(1050), nanoseconds(1051), nanoseconds(1051), nanoseconds(1150)));
}

TEST(Stream, HasOneShareHoweverManyMessagesWait) {
    EventQueue events;
    FlowNetwork network(events, hosts(3));
    Stream first(events, network, nanoseconds(0), 0, 2);
    Stream second(events, network, nanoseconds(0), 1, 2);
    Nanoseconds end{0};
    for (int i = 0; i < 10; ++i) first.send(100, [] {});
    second.send(1000, [&] { end = events.now(); });
    events.run();
    EXPECT_EQ(end, nanoseconds(2000));
}

TEST(Stream, LetsAnArrivalSendOn) {
    EventQueue events;
    FlowNetwork network(events, hosts(2));
    Stream stream(events, network, nanoseconds(5), 0, 1);
    stream.send(10, [&] { stream.send(10, [] {}); });
    events.run();
    EXPECT_EQ(events.now(), nanoseconds(30));
}

}  // namespace
}  // namespace swath::sim
