#pragma once
#include <cstddef>
#include <deque>

#include "sim/engine/event_queue.h"
#include "sim/engine/flow_network.h"

namespace swath::sim {

// A connection's one direction: messages arrive whole and in the order in which they were sent, the bytes of
// one after those of the one before, each after the latency. Not thread-safe. Borrows the network, and lives
// until the events have run.
class Stream {
  public:
    Stream(EventQueue& events, FlowNetwork& network, Nanoseconds latency, std::size_t from, std::size_t to)
        : events_(events), network_(network), latency_(latency), from_(from), to_(to) {}
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;

    // bytes >= 0.
    void send(double bytes, EventQueue::Action arrived);

  private:
    struct Message {
        double bytes;
        EventQueue::Action arrived;
    };
    void flow_next();

    EventQueue& events_;
    FlowNetwork& network_;
    Nanoseconds latency_;
    std::size_t from_;
    std::size_t to_;
    std::deque<Message> waiting_;  // the first is flowing, if flowing_
    bool flowing_ = false;
};

}  // namespace swath::sim
