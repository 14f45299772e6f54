#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "common/base/clock.h"

namespace swath::sim {

// Simulated time and what happens when. Events are ordered by time, then by the order in which they were
// asked for, so a simulation is the same on every run. Not thread-safe: a simulation has its own.
class EventQueue {
  public:
    using Action = std::function<void()>;

    Nanoseconds now() const { return now_; }

    // `when` is not before now() (CHECKed).
    void at(Nanoseconds when, Action action);
    void after(Nanoseconds delay, Action action) { at(now_ + delay, std::move(action)); }

    // Runs events, and those that they ask for, until there are none.
    void run();

    std::uint64_t executed() const { return executed_; }

  private:
    struct Event {
        Nanoseconds when;
        std::uint64_t number;
        Action action;
    };
    std::vector<Event> heap_;
    Nanoseconds now_{0};
    std::uint64_t asked_ = 0;
    std::uint64_t executed_ = 0;
};

}  // namespace swath::sim
