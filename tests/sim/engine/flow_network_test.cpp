#include "sim/engine/flow_network.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>

#include "common/base/check.h"
#include "tests/sim/engine/flows.h"

namespace swath::sim {
namespace {

using std::chrono::nanoseconds;
using test::arrivals;
using testing::ElementsAre;

using test::hosts;
using test::kOne;

class FlowNetworkTest : public testing::Test {
  protected:
    // The rates of long flows that begin together, in bytes a nanosecond.
    static std::vector<double> rates_of(const NetworkRates& rates,
                                        const std::vector<std::pair<std::size_t, std::size_t>>& ends) {
        EventQueue events;
        FlowNetwork network(events, rates);
        std::vector<double> found;
        for (const auto& [from, to] : ends) network.send(from, to, 1e6, [] {});
        events.at(nanoseconds(1), [&] {
            for (const auto& [from, to] : ends) found.push_back(network.rate(from, to) / kOne);
        });
        events.run();
        return found;
    }
};

TEST_F(FlowNetworkTest, GivesALoneFlowTheSlowerOfItsTwoInterfaces) {
    NetworkRates rates = hosts(2);
    rates.hosts[0].out = 4 * kOne;
    rates.hosts[1].in = 2 * kOne;
    EXPECT_THAT(arrivals(rates, {{0, 1, 1000, nanoseconds(0)}}), ElementsAre(nanoseconds(500)));
    rates.hosts[0].out = kOne / 2;
    EXPECT_THAT(arrivals(rates, {{0, 1, 1000, nanoseconds(30)}}), ElementsAre(nanoseconds(2030)));
}

TEST_F(FlowNetworkTest, SharesABottleneckEquallyAndGivesOnWhatAnEndedFlowHad) {
    NetworkRates rates = hosts(4, {10 * kOne, 10 * kOne});
    rates.hosts[3].in = kOne;
    // A third each until 3000, a half each until 5000, then all.
    EXPECT_THAT(arrivals(rates, {{0, 3, 1000, {}}, {1, 3, 2000, {}}, {2, 3, 3000, {}}}),
                ElementsAre(nanoseconds(3000), nanoseconds(5000), nanoseconds(6000)));
}

TEST_F(FlowNetworkTest, SharesBetweenFlowsOfOnePairAsBetweenOthers) {
    EXPECT_THAT(arrivals(hosts(3), {{0, 2, 1000, {}}, {0, 2, 2000, {}}, {1, 2, 3000, {}}}),
                ElementsAre(nanoseconds(3000), nanoseconds(5000), nanoseconds(6000)));
}

TEST_F(FlowNetworkTest, SharesFromTheMomentAtWhichAnotherFlowBegins) {
    // Alone until 1000, then halves until 3000, then alone again.
    EXPECT_THAT(arrivals(hosts(3), {{0, 2, 3000, {}}, {1, 2, 1000, nanoseconds(1000)}}),
                ElementsAre(nanoseconds(4000), nanoseconds(3000)));
}

// Three flows into host 3 have a third each. Host 0's other flow takes the rest of host 0's interface, two
// thirds; shares in proportion to demand would give it a half.
TEST_F(FlowNetworkTest, GivesAFlowWhatOthersOfItsLinkCannotUse) {
    EXPECT_THAT(rates_of(hosts(5), {{0, 3}, {1, 3}, {2, 3}, {0, 4}}),
                ElementsAre(testing::DoubleEq(1. / 3), testing::DoubleEq(1. / 3), testing::DoubleEq(1. / 3),
                            testing::DoubleEq(2. / 3)));
}

// Host 0's four flows have a quarter each; host 1's flow to 2 then has 3/4 of host 2, and its flow to 3 the
// quarter of host 1 that this leaves: three levels, each found from the one before.
TEST_F(FlowNetworkTest, FillsLevelUponLevel) {
    NetworkRates rates = hosts(7);
    rates.hosts[1].out = 2 * kOne;
    EXPECT_THAT(rates_of(rates, {{0, 2}, {0, 4}, {0, 5}, {0, 6}, {1, 2}, {1, 3}}),
                ElementsAre(0.25, 0.25, 0.25, 0.25, 0.75, 1));
    rates.hosts[1].out = 1.5 * kOne;
    EXPECT_THAT(rates_of(rates, {{0, 2}, {0, 4}, {0, 5}, {0, 6}, {1, 2}, {1, 3}}),
                ElementsAre(0.25, 0.25, 0.25, 0.25, 0.75, 0.75));
    rates.hosts[1].out = kOne;
    EXPECT_THAT(rates_of(rates, {{0, 2}, {0, 4}, {0, 5}, {0, 6}, {1, 2}, {1, 3}}),
                ElementsAre(0.25, 0.25, 0.25, 0.25, 0.5, 0.5));
}

TEST_F(FlowNetworkTest, SharesTheCoreAmongAllFlows) {
    NetworkRates rates = hosts(6);
    rates.core = 1.5 * kOne;
    EXPECT_THAT(rates_of(rates, {{0, 1}, {2, 3}, {4, 5}}), ElementsAre(0.5, 0.5, 0.5));
    rates.hosts[0].out = kOne / 4;  // leaves more for the others
    EXPECT_THAT(rates_of(rates, {{0, 1}, {2, 3}, {4, 5}}), ElementsAre(0.25, 0.625, 0.625));
    rates.core = 100 * kOne;
    EXPECT_THAT(rates_of(rates, {{0, 1}, {2, 3}, {4, 5}}), ElementsAre(0.25, 1, 1));
}

TEST_F(FlowNetworkTest, SendsAndReceivesAtOnceWithoutSharing) {
    EXPECT_THAT(arrivals(hosts(2), {{0, 1, 1000, {}}, {1, 0, 1000, {}}}),
                ElementsAre(nanoseconds(1000), nanoseconds(1000)));
}

TEST_F(FlowNetworkTest, TakesNoTimeForNoBytesAndForOneself) {
    EXPECT_THAT(arrivals(hosts(2), {{0, 1, 0, {}}, {1, 1, 1e9, {}}, {0, 1, 100, {}}}),
                ElementsAre(nanoseconds(0), nanoseconds(0), nanoseconds(100)));
}

TEST_F(FlowNetworkTest, RoundsArrivalsUpToWholeNanoseconds) {
    const NetworkRates rates = hosts(2, {3 * kOne, 3 * kOne});
    EXPECT_THAT(arrivals(rates, {{0, 1, 1, {}}}), ElementsAre(nanoseconds(1)));
    EXPECT_THAT(arrivals(rates, {{0, 1, 300, {}}}), ElementsAre(nanoseconds(100)));
    EXPECT_THAT(arrivals(rates, {{0, 1, 301, {}}}), ElementsAre(nanoseconds(101)));
    EXPECT_THAT(arrivals(rates, {{0, 1, 1e-9, {}}}), ElementsAre(nanoseconds(0)));
}

// With 1021 bytes at 97 MB/s among twelve, no number is round.
TEST_F(FlowNetworkTest, LetsEqualFlowsArriveTogether) {
    constexpr std::size_t kHosts = 13;
    for (const std::optional<double> core : {std::optional<double>(), std::optional(3.1e8)}) {
        NetworkRates rates = hosts(kHosts, {97e6, 97e6});
        rates.core = core;
        std::vector<test::TestFlow> flows;
        for (std::size_t from = 0; from < kHosts; ++from)
            for (std::size_t to = 0; to < kHosts; ++to)
                if (from != to) flows.push_back({from, to, 1021, {}});
        const std::vector<Nanoseconds> times = arrivals(rates, flows);
        EXPECT_EQ(std::set(times.begin(), times.end()).size(), 1u);
    }
}

TEST_F(FlowNetworkTest, CallsArrivalsOfOneInstantInTheOrderInWhichTheyWereSent) {
    EventQueue events;
    FlowNetwork network(events, hosts(4));
    std::string order;
    for (const auto& [name, from, to] :
         {std::tuple{'a', 2u, 3u}, {'b', 0u, 1u}, {'c', 2u, 3u}, {'d', 1u, 0u}, {'e', 0u, 1u}})
        network.send(from, to, name == 'd' ? 200 : 100, [&, n = name] { order += n; });
    events.run();
    EXPECT_EQ(order, "abcde");
    EXPECT_EQ(events.now(), nanoseconds(200));
}

TEST_F(FlowNetworkTest, FindsRatesOnceForAllThatHappensAtAnInstant) {
    EventQueue events;
    FlowNetwork network(events, hosts(101));
    for (std::size_t to = 1; to <= 100; ++to) network.send(0, to, 1000, [] {});
    events.run();
    EXPECT_EQ(events.now(), nanoseconds(100'000));
    EXPECT_EQ(events.executed(), 3u);  // sharing, the flows' end, sharing
}

TEST_F(FlowNetworkTest, LetsAnArrivalSendOn) {
    EventQueue events;
    FlowNetwork network(events, hosts(3));
    network.send(0, 1, 100, [&] { network.send(1, 2, 100, [&] { network.send(0, 1, 50, [] {}); }); });
    events.run();
    EXPECT_EQ(events.now(), nanoseconds(250));
    EXPECT_EQ(network.rate(0, 1), 0);
}

TEST_F(FlowNetworkTest, CountsBytesWhenTheyAreSent) {
    EventQueue events;
    FlowNetwork network(events, hosts(3));
    network.send(0, 1, 100, [] {});
    network.send(0, 2, 10, [] {});
    network.send(2, 1, 1, [] {});
    network.send(1, 1, 1000, [] {});
    EXPECT_EQ(network.bytes_out(0), 110);
    EXPECT_EQ(network.bytes_out(1), 0);
    EXPECT_EQ(network.bytes_in(1), 101);
    EXPECT_EQ(network.bytes_in(2), 10);
    EXPECT_EQ(network.bytes(), 111);
    events.run();
    EXPECT_EQ(network.bytes(), 111);
}

TEST_F(FlowNetworkTest, RefusesRatesHostsAndBytesThatMakeNoSense) {
    EventQueue events;
    for (const double rate : {0., -1., std::numeric_limits<double>::infinity(), std::nan("")}) {
        EXPECT_THROW(FlowNetwork(events, hosts(1, {rate, 1})), CheckFailed);
        EXPECT_THROW(FlowNetwork(events, hosts(1, {1, rate})), CheckFailed);
        NetworkRates core = hosts(1);
        core.core = rate;
        EXPECT_THROW(FlowNetwork(events, core), CheckFailed);
    }
    FlowNetwork network(events, hosts(2));
    EXPECT_THROW(network.send(2, 0, 1, [] {}), CheckFailed);
    EXPECT_THROW(network.send(0, 2, 1, [] {}), CheckFailed);
    EXPECT_THROW(network.send(0, 1, -1, [] {}), CheckFailed);
    EXPECT_THROW(network.send(0, 1, std::nan(""), [] {}), CheckFailed);
    EXPECT_THROW(network.send(0, 1, 1, nullptr), CheckFailed);
    EXPECT_EQ(network.bytes(), 0);
}

}  // namespace
}  // namespace swath::sim
