#pragma once
#include "common/base/clock.h"

namespace swath::test {

// For what wants a clock, in tests that do not ask for times.
inline const SteadyClock kClock;

}  // namespace swath::test
