#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "sim/engine/event_queue.h"

namespace swath::sim {

// The rates of one machine's network interface, bytes a second, each way for itself.
struct NicRates {
    double out = 0;
    double in = 0;
};

struct NetworkRates {
    std::vector<NicRates> hosts;
    std::optional<double> core;  // bytes a second that all flows together can have; without: no limit
    Nanoseconds latency{0};      // of every message, before its first byte flows
};

// A crossbar between machines. Messages are fluid flows: at every moment the flows in progress share the
// interfaces (and the core) max-min fairly. Deterministic; not thread-safe.
class FlowNetwork {
  public:
    // Rates are positive and finite (CHECKed).
    FlowNetwork(EventQueue& events, NetworkRates rates);

    // `arrived` is called when the last byte is there: after the latency, and the time the bytes take. Hosts
    // are places in NetworkRates::hosts; a message to oneself takes the latency alone. bytes >= 0.
    void send(std::size_t from, std::size_t to, double bytes, EventQueue::Action arrived);

    // Bytes that have left and entered a host so far, those under way included in full.
    double bytes_out(std::size_t host) const;
    double bytes_in(std::size_t host) const;
    double bytes() const;  // of all hosts
};

}  // namespace swath::sim
