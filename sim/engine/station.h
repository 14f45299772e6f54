#pragma once
#include <cstddef>
#include <deque>
#include <functional>

#include "sim/engine/event_queue.h"

namespace swath::sim {

// Does one job at a time, in the order in which they came: a graphics card, a core, a frame buffer. Borrows
// the queue, and must live until the queue has run its jobs. Not thread-safe.
class Station {
  public:
    using Done = std::function<void(Nanoseconds begin, Nanoseconds end)>;

    explicit Station(EventQueue& events) : events_(events) {}
    Station(const Station&) = delete;
    Station& operator=(const Station&) = delete;

    // Begins the job when those before it have ended, and calls `done` at its end. `duration` must not be
    // negative (CHECKed).
    void submit(Nanoseconds duration, Done done);

    Nanoseconds busy() const { return busy_; }  // total of the jobs submitted so far

  private:
    struct Job {
        Nanoseconds begin;
        Nanoseconds end;
        Done done;
    };

    EventQueue& events_;
    std::deque<Job> jobs_;  // that have not ended
    Nanoseconds free_at_{0};
    Nanoseconds busy_{0};
};

}  // namespace swath::sim
