#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_map>
#include <vector>

#include "sim/engine/event_queue.h"

namespace swath::sim {

// The rates of a machine's network interface, bytes a second, independent of each other.
struct NicRates {
    double out = 0;
    double in = 0;
};

struct NetworkRates {
    std::vector<NicRates> hosts;
    std::optional<double> core;  // bytes a second of all flows together; none: no limit
};

// A crossbar between machines. Messages are fluid flows: at every moment the flows in progress share the
// interfaces (and the core) max-min fairly, each flow for itself: every flow crosses a saturated link on
// which no other flow is faster (Bertsekas and Gallager, Data Networks, section 6.5.2). Rates change only
// when flows begin or end; all changes of an instant are handled at once.
//
// A message arrives at the first whole nanosecond at which all its bytes are there. (For rounding a
// thousandth less, or 1e-12 of its time, so that equal flows arrive together.) Messages of one instant arrive
// in the order in which they were sent. Until then a message keeps its share. Deterministic; not thread-safe.
// Borrows the queue, and must live until the queue has run.
//
// Flows between the same two hosts have the same rate and are one Pair. An instant with changes costs O(P + L
// log L), where P counts the pairs and L the links that are connected to a change by links in use (all of
// them, with a core), and a look at the next end of every pair. Rates below the lowest that can have changed
// stay, which spares their links the logarithm.
class FlowNetwork {
  public:
    // Rates must be positive and finite (CHECKed).
    FlowNetwork(EventQueue& events, NetworkRates rates);
    FlowNetwork(const FlowNetwork&) = delete;
    FlowNetwork& operator=(const FlowNetwork&) = delete;

    // Calls `arrived` when the last byte is there. Hosts are indices of NetworkRates::hosts. A message to
    // oneself, or of no bytes, takes no time. bytes >= 0, finite, and few enough to arrive within 4e18 ns,
    // 127 years (all CHECKed). A Stream adds latency and order.
    void send(std::size_t from, std::size_t to, double bytes, EventQueue::Action arrived);

    // Bytes that have left and entered a host. Messages under way count in full, messages to oneself not at
    // all.
    double bytes_out(std::size_t host) const { return bytes_out_.at(host); }
    double bytes_in(std::size_t host) const { return bytes_in_.at(host); }
    double bytes() const { return bytes_; }  // of all messages, each counted once

    // The rate of each flow between these hosts, in bytes a second, since rates were last found; 0 without a
    // flow.
    double rate(std::size_t from, std::size_t to) const;

  private:
    using Index = std::uint32_t;

    struct Flow {
        Index from;
        Index to;
        double bytes;
        std::uint64_t number;  // by order of send()
        EventQueue::Action arrived;
    };
    struct Waiting {
        double until;  // Pair::served at the flow's end
        std::uint64_t number;
        Index flow;
    };
    // The part of a pair that sharing looks at, apart because it looks at every pair.
    struct Share {
        Index out_link;
        Index in_link;
        Index flows;
        Index round;  // the round of sharing that found `rate`
        double rate;
    };
    // Two hosts with flows between them.
    struct Pair {
        double rate = 0;    // of each flow, from `since` on
        double served = 0;  // until `since`, of a flow that was there from the beginning
        Nanoseconds since{0};
        bool changed = false;  // flows came or went at this instant
        Index active_place = 0;
        Index out_place = 0;
        Index in_place = 0;
        std::vector<Waiting> flows;
    };
    struct Link {
        double rate = 0;
        Index flows = 0;
        Index round = 0;       // the round of sharing that reached it
        bool touched = false;  // is in touched_
        bool grown = false;    // has a flow that began at this instant
        double given = 0;      // while sharing: rates of flows whose rate is found
        double open = 0;       // while sharing: number of flows whose rate is not
        std::vector<Index> pairs;
        double level() const { return (rate - given) / open; }
    };
    struct Level {
        double level;
        Index link;
    };

    bool has_core() const { return core_.rate > 0; }
    void begin(Index flow);
    void end_flows();
    void share();
    void reach();
    void find_kept();
    void fill();
    void give(Index pair, double rate);
    void apply(Index pair);
    void wake_at_next_end();

    Index pair_of(Index from, Index to);
    void activate(Index pair);
    void deactivate(Index pair);
    void change(Index pair);
    void count(Index pair, int flows);
    double served(const Pair& pair) const;
    Nanoseconds end_of(const Pair& pair) const;

    EventQueue& events_;
    std::vector<Link> links_;  // out of each host, then into each host
    Link core_;                // rate 0: there is none
    std::vector<double> bytes_out_;
    std::vector<double> bytes_in_;
    double bytes_ = 0;

    std::vector<Flow> flows_;
    std::vector<Index> free_flows_;
    std::uint64_t sent_ = 0;
    std::unordered_map<std::uint64_t, Index> pair_index_;  // for look-up only: its order is not deterministic
    std::vector<Pair> pairs_;
    std::vector<Share> shares_;      // by pair
    std::vector<Index> active_;      // pairs with flows
    std::vector<Nanoseconds> ends_;  // by active_: the end of the pair's first flow

    std::size_t links_in_use_ = 0;
    bool sharing_asked_ = false;
    double lowest_ended_ = std::numeric_limits<double>::infinity();  // rate of flows that ended just now
    double kept_ = 0;                                                // rates below this stay
    Index round_ = 0;
    std::vector<Index> touched_;  // links
    std::vector<Index> reached_links_;
    std::vector<Index> reached_pairs_;
    std::vector<Level> levels_;
    std::vector<Waiting> ended_;

    Nanoseconds wake_at_{0};
    std::optional<EventQueue::Ticket> wake_;
};

}  // namespace swath::sim
