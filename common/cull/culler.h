#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/geometry/box.h"
#include "common/geometry/frustum.h"

namespace swath {

// Finds the boxes that may be seen. Every algorithm gives the same answer: all boxes that are not
// outside(frustum, box), ascending. One thread at a time. A ThreadTeam that it was made with must outlive it
// and be idle when it is called.
class Culler {
  public:
    virtual ~Culler() = default;
    // The indices of the boxes, ascending. Valid until the next call.
    virtual std::span<const std::uint32_t> cull(const Frustum& frustum) = 0;
    // Moves the boxes. There must be as many as before.
    virtual void refit(std::span<const Box> boxes) = 0;
    // The octree's level at which the last cull() shared its work among threads, if the algorithm has one.
    virtual std::optional<int> split_level() const { return std::nullopt; }
};

}  // namespace swath
