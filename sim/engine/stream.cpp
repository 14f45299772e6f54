#include "sim/engine/stream.h"

#include <utility>

namespace swath::sim {

void Stream::send(double bytes, EventQueue::Action arrived) {
    events_.after(latency_, [this, message = Message{bytes, std::move(arrived)}]() mutable {
        waiting_.push_back(std::move(message));
        if (!flowing_) flow_next();
    });
}

void Stream::flow_next() {
    flowing_ = !waiting_.empty();
    if (!flowing_) return;
    network_.send(from_, to_, waiting_.front().bytes, [this] {
        const EventQueue::Action arrived = std::move(waiting_.front().arrived);
        waiting_.pop_front();
        flow_next();
        arrived();
    });
}

}  // namespace swath::sim
