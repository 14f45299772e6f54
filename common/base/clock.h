#pragma once
#include <chrono>
#include <cstdint>

namespace swath {

// Points on a machine's monotonic clock and lengths of time. What programs exchange and record is in
// nanoseconds.
using Nanoseconds = std::chrono::nanoseconds;

// Where time comes from. `main` makes a SteadyClock; tests and the simulator bring their own.
// Thread-safe implementations only: any thread may ask.
class Clock {
  public:
    virtual ~Clock() = default;
    // Since an arbitrary fixed point of this machine; never goes back.
    virtual Nanoseconds now() const = 0;
    // CPU time spent by the calling thread.
    virtual Nanoseconds thread_cpu() const = 0;
};

class SteadyClock final : public Clock {
  public:
    Nanoseconds now() const override;
    Nanoseconds thread_cpu() const override;
};

}  // namespace swath
