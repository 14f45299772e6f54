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

// A team of threads that works through short tasks together: the "minimum thread management system" of both
// culling papers (ADSB, section 7 and appendix A: Init, SetTask, StartWorking, WaitUntilWorkFinished).
// Member 0 is the caller; the others are threads that sleep between tasks. All calls come from one thread,
// the caller's. There may be more members than cores: a waiting thread spins for a moment, then yields, then
// sleeps, and wait() does itself what no other member has begun, so a busy machine costs no more than doing
// it all alone. Tasks must not call the team. A task may throw unless another waits for it.
class ThreadTeam {
  public:
    // `size` members, at least 1; size - 1 threads are started. Where the system refuses one (a container's
    // limit), the caller does that member's tasks. `clock` must outlive the team.
    ThreadTeam(std::size_t size, const Clock& clock);
    // No task may be under way.
    ~ThreadTeam();
    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    std::size_t size() const { return members_.size(); }
    const Clock& clock() const { return clock_; }

    // What `member` does when it is started next. Member 0 does its task in wait().
    void set_task(std::size_t member, std::function<void()> task);
    void start(std::size_t member);
    // Does member 0's task if it was started, then those of members that have not begun, and blocks until all
    // are done. What tasks wrote is visible afterwards. Throws what a task threw (of several, the first
    // member's), when all are done.
    void wait();

    // The same task for every member, or the first `members`, started and waited for. The order in which they
    // begin is open.
    void run(const std::function<void(std::size_t member)>& task) { run(size(), task); }
    void run(std::size_t members, const std::function<void(std::size_t member)>& task);

    // When the member's last task began and ended, whoever did it. Valid after wait().
    Nanoseconds start_time(std::size_t member) const { return members_[member]->begin; }
    Nanoseconds end_time(std::size_t member) const { return members_[member]->end; }

  private:
    enum State : std::uint32_t { kIdle, kStarted, kRunning, kStopped };
    // A cache line each: members write their own.
    struct alignas(64) Member {
        std::atomic<std::uint32_t> state{kIdle};
        std::function<void()> task;
        Nanoseconds begin{0};
        Nanoseconds end{0};
        std::exception_ptr thrown;
        std::thread thread;  // none for member 0, nor where there could not be one
    };
    void live(Member& member);
    // Does the member's task if it is started and nobody has begun it.
    bool take(Member& member);

    const Clock& clock_;
    std::vector<std::unique_ptr<Member>> members_;
};

}  // namespace swath
