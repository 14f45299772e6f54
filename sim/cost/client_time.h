#pragma once
#include <cstddef>

#include "client/partition/partitioner.h"
#include "sim/hardware/hardware.h"

namespace swath::sim {

// The client's time for a frame, in seconds: boxes to the screen and, unless groups are static (sort-last),
// the partition. Thread-safe.
double client_s(std::size_t objects, std::size_t servers, Algorithm algorithm, const Hardware& hardware);

}  // namespace swath::sim
