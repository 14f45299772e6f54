#pragma once
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "common/base/clock.h"

namespace swath::sim {

// Simulated time and what happens when. Events are ordered by time, then by the order in which they were
// asked for, so a simulation is the same on every run. Not thread-safe: a simulation has its own.
//
// Time is whole nanoseconds. Asking for an event and running it is O(log n) with n waiting; a cancelled event
// keeps its place in the heap until its time comes, without effect.
class EventQueue {
  public:
    using Action = std::function<void()>;

    // Names an event that was asked for.
    struct Ticket {
        std::uint64_t number;
        std::uint32_t slot;
    };

    EventQueue() = default;
    EventQueue(const EventQueue&) = delete;
    EventQueue& operator=(const EventQueue&) = delete;

    Nanoseconds now() const { return now_; }

    // `when` is not before now() (CHECKed), `action` can be called (CHECKed).
    Ticket at(Nanoseconds when, Action action);
    Ticket after(Nanoseconds delay, Action action) { return at(now_ + delay, std::move(action)); }

    // Runs when nothing else is left to do now, before time moves on: for what depends on all that happens at
    // one instant. Events that it asks for now come before the next such action.
    Ticket at_end_of_instant(Action action);

    // The event does not happen, and time does not stop at it. Nothing, if it happened or was cancelled.
    void cancel(Ticket ticket);

    // Runs events, and those that they ask for, until there are none. now() is then the last event's time. An
    // exception from an action leaves the queue without that event, and usable.
    void run();

    std::uint64_t executed() const { return executed_; }

  private:
    // Small, since sifting moves them about; actions stay in their slots.
    struct Key {
        Nanoseconds when;
        std::uint64_t number;  // the highest bit: at the end of the instant
        std::uint32_t slot;
        bool operator<(const Key& other) const {
            return when != other.when ? when < other.when : number < other.number;
        }
    };
    struct Slot {
        Action action;  // empty: cancelled
        std::uint64_t number = 0;
    };

    Ticket add(Nanoseconds when, std::uint64_t number, Action action);
    Key pop();

    std::vector<Key> heap_;  // each parent is before its four children
    std::vector<Slot> slots_;
    std::vector<std::uint32_t> free_slots_;
    Nanoseconds now_{0};
    std::uint64_t asked_ = 0;
    std::uint64_t executed_ = 0;
};

}  // namespace swath::sim
