#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "sim/engine/flow_network.h"
#include "tests/sim/engine/flows.h"

namespace swath::sim {
namespace {

struct PeerSet {
    std::string name;
    NetworkRates rates;
    Nanoseconds latency{0};
    std::vector<test::TestFlow> flows;
    std::vector<Nanoseconds> finished;
};

// tests/sim/peer/README.md has the format.
std::vector<PeerSet> read_sets() {
    std::ifstream file(SWATH_PEER_FLOWS);
    std::vector<PeerSet> sets;
    for (std::string text; std::getline(file, text);) {
        std::istringstream line(text);
        std::string kind;
        line >> kind;
        if (kind == "set") {
            PeerSet& set = sets.emplace_back();
            std::size_t hosts = 0;
            double core = 0;
            std::int64_t latency = 0;
            line >> set.name >> hosts >> core >> latency;
            if (core > 0) set.rates.core = core;
            set.latency = Nanoseconds(latency);
        } else if (kind == "host") {
            NicRates& nic = sets.back().rates.hosts.emplace_back();
            line >> nic.out >> nic.in;
        } else if (kind == "flow") {
            test::TestFlow& flow = sets.back().flows.emplace_back();
            std::int64_t start = 0;
            std::int64_t finished = 0;
            line >> flow.from >> flow.to >> flow.bytes >> start >> finished;
            flow.start = Nanoseconds(start);
            sets.back().finished.emplace_back(finished);
        }
        EXPECT_TRUE(line) << text;
    }
    return sets;
}

// The bound is 1 % of each flow's time; rounding to nanoseconds is far less.
TEST(FlowNetwork, AgreesWithSimGridsFluidModel) {
    const std::vector<PeerSet> sets = read_sets();
    ASSERT_GE(sets.size(), 12u);
    double worst = 0;
    for (const PeerSet& set : sets) {
        SCOPED_TRACE(set.name);
        ASSERT_FALSE(set.flows.empty());
        const std::vector<Nanoseconds> times = test::arrivals(set.rates, set.flows, set.latency);
        for (std::size_t i = 0; i < set.flows.size(); ++i) {
            const auto taken = static_cast<double>((times[i] - set.flows[i].start).count());
            const auto expected = static_cast<double>((set.finished[i] - set.flows[i].start).count());
            ASSERT_GT(expected, 0);
            const double off = std::abs(taken - expected) / expected;
            EXPECT_LE(off, 0.01) << "flow " << i << ": " << taken << " ns, SimGrid " << expected << " ns";
            worst = std::max(worst, off);
        }
    }
    RecordProperty("worst_relative_difference", std::to_string(worst));
}

}  // namespace
}  // namespace swath::sim
