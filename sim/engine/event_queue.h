#pragma once
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "common/base/clock.h"

namespace swath::sim {

// Simulated time, and the events that will happen. Events are ordered by time, then by when they were added,
// so a simulation is the same on every run. Not thread-safe.
//
// Time is whole nanoseconds. To add an event and run it is O(log n) with n waiting. A cancelled event stays
// in the heap, without effect, until its time comes.
class EventQueue {
  public:
    using Action = std::function<void()>;

    // Identifies an added event.
    struct Ticket {
        std::uint64_t number;
        std::uint32_t slot;
    };

    EventQueue() = default;
    EventQueue(const EventQueue&) = delete;
    EventQueue& operator=(const EventQueue&) = delete;

    Nanoseconds now() const { return now_; }

    // `when` must not be before now(), and `action` must be callable (both CHECKed).
    Ticket at(Nanoseconds when, Action action);
    Ticket after(Nanoseconds delay, Action action) { return at(now_ + delay, std::move(action)); }

    // Runs `action` when no other event is left at this instant, before time moves on: it sees all that
    // happened now. Events that it adds for now run before the next such action.
    Ticket at_end_of_instant(Action action);

    // Removes the event: time will not stop at it. Does nothing if it happened or was cancelled.
    void cancel(Ticket ticket);

    // Runs events, and those that they add, until none is left. now() is then the last event's time. An
    // exception from an action removes that event and leaves the queue usable.
    void run();

    std::uint64_t executed() const { return executed_; }

  private:
    // Small, because sifting moves keys; actions stay in their slots.
    struct Key {
        Nanoseconds when;
        std::uint64_t number;  // highest bit set: at the end of the instant
        std::uint32_t slot;
        bool operator<(const Key& other) const {
            return when != other.when ? when < other.when : number < other.number;
        }
    };
    struct Slot {
        Action action;  // empty if cancelled
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
