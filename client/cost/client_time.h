#pragma once
#include <cstddef>

#include "client/cost/hardware.h"
#include "client/partition/partitioner.h"

namespace swath {

// The client's seconds for a frame: it projects the boxes and, unless groups are static (sort-last),
// partitions. Thread-safe.
double client_s(std::size_t objects, std::size_t servers, Algorithm algorithm, const Hardware& hardware);

}  // namespace swath
