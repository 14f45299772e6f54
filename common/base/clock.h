#pragma once
#include <chrono>
#include <cstdint>

namespace swath {

// The unit of time that programs record and exchange: points on a machine's monotonic clock, and lengths.
using Nanoseconds = std::chrono::nanoseconds;
inline double milliseconds(Nanoseconds time) { return static_cast<double>(time.count()) / 1e6; }

// Tells the time. `main` makes a SteadyClock; tests and the simulator bring their own. Implementations are
// thread-safe.
class Clock {
  public:
    virtual ~Clock() = default;
    // The time since a fixed point of this machine. It never goes back.
    virtual Nanoseconds now() const = 0;
    // The CPU time that the calling thread has spent.
    virtual Nanoseconds thread_cpu() const = 0;
};

class SteadyClock final : public Clock {
  public:
    Nanoseconds now() const override;
    Nanoseconds thread_cpu() const override;
};

}  // namespace swath
