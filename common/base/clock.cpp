#include "common/base/clock.h"

#include <ctime>

namespace swath {

Nanoseconds SteadyClock::now() const { return std::chrono::steady_clock::now().time_since_epoch(); }

Nanoseconds SteadyClock::thread_cpu() const {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return std::chrono::seconds(time.tv_sec) + Nanoseconds(time.tv_nsec);
}

}  // namespace swath
