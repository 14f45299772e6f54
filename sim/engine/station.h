#pragma once
#include <cstddef>
#include <deque>
#include <functional>

#include "sim/engine/event_queue.h"

namespace swath::sim {

// Something that does one job at a time, in the order in which they came: a graphics card, a core, a frame
// buffer. Borrows the queue, and lives until the queue has run its jobs. Not thread-safe.
class Station {
  public:
    using Done = std::function<void(Nanoseconds begin, Nanoseconds end)>;

    explicit Station(EventQueue& events) : events_(events) {}
    Station(const Station&) = delete;
    Station& operator=(const Station&) = delete;

    // The job begins now, or when those before it have ended. `duration` is not negative (CHECKed). `done` is
    // called at the job's end.
    void submit(Nanoseconds duration, Done done);

    Nanoseconds busy() const { return busy_; }  // in all, of the jobs submitted so far

  private:
    struct Job {
        Nanoseconds begin;
        Nanoseconds end;
        Done done;
    };

    EventQueue& events_;
    std::deque<Job> jobs_;  // not ended
    Nanoseconds free_at_{0};
    Nanoseconds busy_{0};
};

}  // namespace swath::sim
