#pragma once
#include <cstddef>

#include "client/cost/hardware.h"
#include "client/partition/partitioner.h"

namespace swath {

// The client's time for a frame, in seconds: boxes to the screen and, unless groups are static (sort-last),
// the partition. Thread-safe.
double client_s(std::size_t objects, std::size_t servers, Algorithm algorithm, const Hardware& hardware);

}  // namespace swath
