#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include "sim/engine/flow_network.h"
#include "tests/sim/engine/flows.h"

namespace swath::sim {
namespace {

using std::chrono::microseconds;
using test::TestFlow;

constexpr double kTolerance = 1e-8;

struct Case {
    std::size_t hosts;
    std::size_t flows;
    bool equal_rates;
    double core;  // share of all out links; 0: none
    Nanoseconds starts;
    Nanoseconds latency;
};

void PrintTo(const Case& of, std::ostream* out) {
    *out << of.hosts << " hosts, " << of.flows << " flows, core " << of.core << ", latency "
         << of.latency.count() << " ns";
}

class FlowNetworkOn : public testing::TestWithParam<Case> {
  protected:
    void SetUp() override {
        const Case& of = GetParam();
        std::mt19937_64 random(of.hosts * 1000 + of.flows);
        rates_ = test::random_rates(random, of.hosts, of.equal_rates);
        latency_ = of.latency;
        double all = 0;
        for (const NicRates& nic : rates_.hosts) all += nic.out;
        if (of.core > 0) rates_.core = of.core * all;
        flows_ = test::random_flows(random, of.hosts, of.flows, of.starts);
        for (int i = 0; i < 60; ++i)
            probes_.emplace_back(random() % static_cast<std::uint64_t>((2 * of.starts).count()));
    }

    // Expects that no link carries more than its rate, and that each flow crosses a full link on which none
    // is faster.
    void expect_fair(const std::vector<TestFlow>& under_way, const std::vector<double>& found) const {
        const std::size_t hosts = rates_.hosts.size();
        std::vector<double> limit;
        for (const NicRates& nic : rates_.hosts) limit.push_back(nic.out);
        for (const NicRates& nic : rates_.hosts) limit.push_back(nic.in);
        limit.push_back(rates_.core.value_or(1e30));
        std::vector<double> load(limit.size());
        std::vector<double> fastest(limit.size());
        const auto links = [&](const TestFlow& flow) {
            return std::vector<std::size_t>{flow.from, hosts + flow.to, 2 * hosts};
        };
        for (std::size_t i = 0; i < found.size(); ++i) {
            for (const std::size_t link : links(under_way[i])) {
                load[link] += found[i];
                fastest[link] = std::max(fastest[link], found[i]);
            }
        }
        for (std::size_t link = 0; link < limit.size(); ++link)
            EXPECT_LE(load[link], limit[link] * (1 + kTolerance)) << "link " << link;
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_TRUE(std::ranges::any_of(links(under_way[i]),
                                            [&](std::size_t link) {
                                                return load[link] >= limit[link] * (1 - kTolerance) &&
                                                       fastest[link] <= found[i] * (1 + kTolerance);
                                            }))
                << "flow " << i << " could be faster";
        }
    }

    NetworkRates rates_;
    Nanoseconds latency_{0};
    std::vector<TestFlow> flows_;
    std::vector<Nanoseconds> probes_;
};

TEST_P(FlowNetworkOn, SharesMaxMinFairlyAtEveryMoment) {
    EventQueue events;
    FlowNetwork network(events, rates_);
    std::vector<bool> under_way(flows_.size());
    for (std::size_t i = 0; i < flows_.size(); ++i) {
        events.at(flows_[i].start, [&, i] {
            network.send(flows_[i].from, flows_[i].to, flows_[i].bytes, [&, i] { under_way[i] = false; });
            under_way[i] = true;
        });
    }
    std::size_t seen = 0;
    for (const Nanoseconds probe : probes_) {
        events.at(probe, [&] {
            std::vector<TestFlow> now;
            std::vector<double> found;
            for (std::size_t i = 0; i < flows_.size(); ++i) {
                if (!under_way[i]) continue;
                now.push_back(flows_[i]);
                found.push_back(network.rate(flows_[i].from, flows_[i].to));
            }
            seen += now.size();
            expect_fair(now, found);
            const std::vector<double> expected = test::filled_rates(rates_, now);
            for (std::size_t i = 0; i < now.size(); ++i)
                EXPECT_NEAR(found[i], expected[i], kTolerance * expected[i]);
        });
    }
    events.run();
    EXPECT_GT(seen, flows_.size());
}

TEST_P(FlowNetworkOn, AgreesWithASlowSimulationOfTheSameFlows) {
    const std::vector<Nanoseconds> times = test::arrivals(rates_, flows_, latency_);
    const std::vector<double> expected = test::slow_arrivals(rates_, flows_, latency_);
    // Each end before a flow's own may be up to a nanosecond late.
    const double rounding = static_cast<double>(flows_.size());
    for (std::size_t i = 0; i < flows_.size(); ++i)
        EXPECT_NEAR(static_cast<double>(times[i].count()), expected[i] * 1e9, rounding) << "flow " << i;
}

TEST_P(FlowNetworkOn, IsTheSameOnEveryRun) {
    EXPECT_EQ(test::arrivals(rates_, flows_, latency_), test::arrivals(rates_, flows_, latency_));
}

INSTANTIATE_TEST_SUITE_P(RandomFlows, FlowNetworkOn,
                         testing::Values(Case{2, 20, false, 0, microseconds(1000), {}},
                                         Case{3, 60, true, 0, microseconds(4000), {}},
                                         Case{5, 100, false, 0.5, microseconds(4000), microseconds(70)},
                                         Case{8, 150, false, 0, microseconds(2000), {}},
                                         Case{16, 300, true, 0.4, microseconds(3000), {}},
                                         Case{16, 300, false, 0, microseconds(2000), microseconds(50)},
                                         Case{40, 400, false, 0.2, microseconds(1500), {}},
                                         Case{64, 500, false, 0, microseconds(1000), {}},
                                         Case{64, 60, true, 0, microseconds(1000), {}}));

// Flows come and go, but a link that is never idle is busy for exactly the time of its bytes: none are lost,
// none are carried twice.
TEST(FlowNetwork, CarriesEveryByteOnce) {
    std::mt19937_64 random(3);
    constexpr std::size_t kHosts = 20;
    NetworkRates rates;
    rates.hosts.assign(kHosts, {1e9, 1e9});
    std::vector<TestFlow> flows;
    double bytes = 0;
    for (int i = 0; i < 500; ++i) {
        const auto size = static_cast<double>(1 + random() % 100'000);
        flows.push_back({1 + random() % (kHosts - 1), 0, size, Nanoseconds(random() % 5'000'000)});
        bytes += size;
    }
    flows.front().start = Nanoseconds(0);
    flows.front().bytes += 5e6;
    bytes += 5e6;
    const std::vector<Nanoseconds> times = test::arrivals(rates, flows);
    const auto last = static_cast<double>(std::ranges::max(times).count());
    EXPECT_GE(last, bytes);
    EXPECT_LE(last, bytes + static_cast<double>(flows.size()));  // ends are rounded up
}

}  // namespace
}  // namespace swath::sim
