#include "common/base/thread_team.h"

#include <utility>

#include "common/base/check.h"

namespace swath {
namespace {

// A short wait should not pay for a system call, and a long one should leave the core to others. With more
// threads than cores, spinning alone was up to four times slower; sleeping at once cost milliseconds a frame
// on a busy machine.
constexpr int kSpins = 200;
constexpr int kYields = 50;

void pause() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
}

// Blocks until `state` is not `while_is` and returns what it is.
std::uint32_t await_change(const std::atomic<std::uint32_t>& state, std::uint32_t while_is) {
    for (int i = 0; i < kSpins + kYields; ++i) {
        if (const std::uint32_t now = state.load(std::memory_order_acquire); now != while_is) return now;
        if (i < kSpins)
            pause();
        else
            std::this_thread::yield();
    }
    state.wait(while_is, std::memory_order_acquire);
    return state.load(std::memory_order_acquire);
}

// Stores a value and wakes who waits for it. The store must be sequentially consistent: libstdc++ looks
// whether anybody sleeps before it makes the system call, and after a mere release it could look before the
// store is visible, and so lose the wake-up.
void announce(std::atomic<std::uint32_t>& state, std::uint32_t value) {
    state.store(value, std::memory_order_seq_cst);
    state.notify_all();
}

}  // namespace

ThreadTeam::ThreadTeam(std::size_t size, const Clock& clock) : clock_(clock) {
    CHECK(size >= std::size_t{1});
    for (std::size_t i = 0; i < size; ++i) members_.push_back(std::make_unique<Member>());
    try {
        for (std::size_t i = 1; i < size; ++i)
            members_[i]->thread = std::thread([this, &member = *members_[i]] { live(member); });
    } catch (const std::exception&) {
        // With fewer threads, wait() does the tasks of members that have none.
    }
}

ThreadTeam::~ThreadTeam() {
    for (const auto& member : members_) {
        if (!member->thread.joinable()) continue;
        announce(member->state, kStopped);
        member->thread.join();
    }
}

void ThreadTeam::live(Member& member) {
    for (;;) {
        switch (await_change(member.state, kIdle)) {
            case kStopped:
                return;
            case kStarted:
                take(member);
                break;
            default:  // the caller is doing this member's task itself
                await_change(member.state, kRunning);
        }
    }
}

bool ThreadTeam::take(Member& member) {
    std::uint32_t expected = kStarted;
    if (!member.state.compare_exchange_strong(expected, kRunning, std::memory_order_acq_rel)) return false;
    member.begin = clock_.now();
    try {
        member.task();
    } catch (...) {
        member.thrown = std::current_exception();
    }
    member.end = clock_.now();
    announce(member.state, kIdle);
    return true;
}

void ThreadTeam::set_task(std::size_t member, std::function<void()> task) {
    CHECK(member < size());
    CHECK(members_[member]->state.load(std::memory_order_acquire) == kIdle);
    members_[member]->task = std::move(task);
}

void ThreadTeam::start(std::size_t member) {
    CHECK(member < size());
    CHECK(static_cast<bool>(members_[member]->task));
    CHECK(members_[member]->state.load(std::memory_order_acquire) == kIdle);
    announce(members_[member]->state, kStarted);
}

void ThreadTeam::wait() {
    for (const auto& member : members_) take(*member);
    for (const auto& member : members_) await_change(member->state, kRunning);
    std::exception_ptr first;
    for (const auto& member : members_)
        if (member->thrown) {
            const std::exception_ptr thrown = std::exchange(member->thrown, nullptr);
            if (!first) first = thrown;
        }
    if (first) std::rethrow_exception(first);
}

void ThreadTeam::run(std::size_t members, const std::function<void(std::size_t member)>& task) {
    CHECK(members <= size());
    for (std::size_t i = members; i-- > 0;) {
        members_[i]->task = [&task, i] { task(i); };
        start(i);
    }
    wait();
}

}  // namespace swath
