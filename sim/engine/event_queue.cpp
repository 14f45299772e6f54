#include "sim/engine/event_queue.h"

#include <algorithm>

#include "common/base/check.h"

namespace swath::sim {
namespace {

// With four children a node, the heap has half the levels of a binary one, and siblings lie next to each
// other.
constexpr std::size_t kArity = 4;
constexpr std::uint64_t kEndOfInstant = std::uint64_t{1} << 63;

}  // namespace

EventQueue::Ticket EventQueue::at(Nanoseconds when, Action action) {
    CHECK(when.count() >= now_.count());
    return add(when, asked_++, std::move(action));
}

EventQueue::Ticket EventQueue::at_end_of_instant(Action action) {
    return add(now_, kEndOfInstant | asked_++, std::move(action));
}

EventQueue::Ticket EventQueue::add(Nanoseconds when, std::uint64_t number, Action action) {
    CHECK(static_cast<bool>(action));
    std::uint32_t slot = 0;
    if (free_slots_.empty()) {
        slot = static_cast<std::uint32_t>(slots_.size());
        slots_.push_back({std::move(action), number});
    } else {
        slot = free_slots_.back();
        free_slots_.pop_back();
        slots_[slot].action = std::move(action);
        slots_[slot].number = number;
    }
    const Key key{when, number, slot};
    std::size_t place = heap_.size();
    heap_.push_back(key);
    while (place > 0) {
        const std::size_t parent = (place - 1) / kArity;
        if (!(key < heap_[parent])) break;
        heap_[place] = heap_[parent];
        place = parent;
    }
    heap_[place] = key;
    return {number, slot};
}

EventQueue::Key EventQueue::pop() {
    const Key first = heap_.front();
    const Key moved = heap_.back();
    heap_.pop_back();
    const std::size_t size = heap_.size();
    if (size == 0) return first;
    std::size_t place = 0;
    for (;;) {
        const std::size_t child = place * kArity + 1;
        if (child >= size) break;
        std::size_t least = child;
        const std::size_t end = std::min(child + kArity, size);
        for (std::size_t c = child + 1; c < end; ++c)
            if (heap_[c] < heap_[least]) least = c;
        if (!(heap_[least] < moved)) break;
        heap_[place] = heap_[least];
        place = least;
    }
    heap_[place] = moved;
    return first;
}

void EventQueue::cancel(Ticket ticket) {
    Slot& slot = slots_.at(ticket.slot);
    if (slot.number == ticket.number) slot.action = nullptr;
}

void EventQueue::run() {
    while (!heap_.empty()) {
        const Key key = pop();
        // The action leaves its slot first, since it may give the slot to another event.
        const Action action = std::exchange(slots_[key.slot].action, nullptr);
        free_slots_.push_back(key.slot);
        if (!action) continue;
        now_ = key.when;
        ++executed_;
        action();
    }
}

}  // namespace swath::sim
