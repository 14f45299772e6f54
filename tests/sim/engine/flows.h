#pragma once
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "sim/engine/flow_network.h"

namespace swath::sim::test {

struct TestFlow {
    std::size_t from = 0;
    std::size_t to = 0;
    double bytes = 0;
    Nanoseconds start{0};
};

// One byte a nanosecond: bytes and nanoseconds are the same number.
inline constexpr double kOne = 1e9;
NetworkRates hosts(std::size_t count, NicRates nic = {kOne, kOne});

// Rates of 10 to 1000 MB/s each way, or all of 100 MB/s.
NetworkRates random_rates(std::mt19937_64& random, std::size_t hosts, bool equal);

// Flows between different hosts, of 1 byte to 100 kB, that start within `starts`.
std::vector<TestFlow> random_flows(std::mt19937_64& random, std::size_t hosts, std::size_t flows,
                                   Nanoseconds starts);

// Arrival times of flows that have a connection (Stream) each.
std::vector<Nanoseconds> arrivals(const NetworkRates& rates, const std::vector<TestFlow>& flows,
                                  Nanoseconds latency = Nanoseconds(0));

// Max-min fair rates by the book: all flows rise by the same step until a link is full, again and again.
// Slow; shares no code with FlowNetwork.
std::vector<double> filled_rates(const NetworkRates& rates, const std::vector<TestFlow>& flows);

// Arrival times in seconds, with filled_rates() from one start or end to the next.
std::vector<double> slow_arrivals(const NetworkRates& rates, const std::vector<TestFlow>& flows,
                                  Nanoseconds latency);

}  // namespace swath::sim::test
