#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "common/base/clock.h"

namespace swath {

// Threads that do short tasks together: the "minimum thread management system" of both culling papers (ADSB,
// section 7 and appendix A: Init, SetTask, StartWorking, WaitUntilWorkFinished). Member 0 is the caller, the
// others are threads that sleep between tasks. All calls come from the caller's thread. There may be more
// members than cores: a waiting thread spins for a moment, then yields, then sleeps, and wait() does itself
// what no other member has begun, so that on a busy machine a team is no slower than one thread. Tasks must
// not call the team. A task may throw unless another task waits for it.
class ThreadTeam {
  public:
    // `size` is the number of members, at least 1. Starts size - 1 threads; where the system refuses one (a
    // container's limit), the caller does that member's tasks. `clock` must outlive the team.
    ThreadTeam(std::size_t size, const Clock& clock);
    // Call it only when no task is under way.
    ~ThreadTeam();
    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    std::size_t size() const { return members_.size(); }
    const Clock& clock() const { return clock_; }

    // Sets what `member` does when it is started next. Member 0 does its task in wait().
    void set_task(std::size_t member, std::function<void()> task);
    void start(std::size_t member);
    // Does the started tasks that nobody has begun, member 0's first, and blocks until all are done. What
    // tasks wrote is visible afterwards. Then throws what the lowest member's task threw, if any did.
    void wait();

    // Has every member, or the first `members`, do the same task, and waits. They begin in any order.
    void run(const std::function<void(std::size_t member)>& task) { run(size(), task); }
    void run(std::size_t members, const std::function<void(std::size_t member)>& task);

    // When the member's last task began and ended, no matter which thread did it. Valid after wait().
    Nanoseconds start_time(std::size_t member) const { return members_[member]->begin; }
    Nanoseconds end_time(std::size_t member) const { return members_[member]->end; }

  private:
    enum State : std::uint32_t { kIdle, kStarted, kRunning, kStopped };
    // Each member writes its own state, so each has a cache line of its own.
    struct alignas(64) Member {
        std::atomic<std::uint32_t> state{kIdle};
        std::function<void()> task;
        Nanoseconds begin{0};
        Nanoseconds end{0};
        std::exception_ptr thrown;
        std::thread thread;  // not joinable for member 0 and where the system refused one
    };
    void live(Member& member);
    // Does the member's task if it is started and nobody has begun it. Returns whether it did.
    bool take(Member& member);

    const Clock& clock_;
    std::vector<std::unique_ptr<Member>> members_;
};

}  // namespace swath
