#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/geometry/box.h"
#include "common/geometry/frustum.h"

namespace swath {

// Finds which of a set of boxes may be seen. Whatever the algorithm, the answer is the same: all boxes
// that are not outside(frustum, box), ascending. One thread at a time; a ThreadTeam that it was made with
// must outlive it and be idle when it is called.
class Culler {
  public:
    virtual ~Culler() = default;
    // Indices of the boxes, ascending. The span is valid until the next call.
    virtual std::span<const std::uint32_t> cull(const Frustum& frustum) = 0;
    // The same boxes somewhere else, as many as there were, from now on.
    virtual void refit(std::span<const Box> boxes) = 0;
    // The level of the octree at which the last call shared out its work, of algorithms that have one.
    virtual std::optional<int> split_level() const { return std::nullopt; }
};

}  // namespace swath
