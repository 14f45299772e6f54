#pragma once
#include <cstddef>
#include <deque>

#include "sim/engine/event_queue.h"
#include "sim/engine/flow_network.h"

namespace swath::sim {

// One direction of a connection. Messages arrive whole and in the order in which they were sent: the bytes of
// one flow after those of the one before, and each message arrives the latency later. Not thread-safe.
// Borrows the network, and must live until the events have run.
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
    std::deque<Message> waiting_;  // if flowing_, the first one is under way
    bool flowing_ = false;
};

}  // namespace swath::sim
