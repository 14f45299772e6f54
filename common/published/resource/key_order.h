#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/base/thread_team.h"

namespace swath {

// The order of all objects by (key, id), which is known beforehand if keys do not change. An object's rank is
// its index in that order, so sorting visible objects is finding their ranks in ascending order (RankBitmap),
// and objects that are numbered by rank need no sorting. Immutable.
class KeyOrder {
  public:
    KeyOrder(std::span<const std::uint32_t> keys, ThreadTeam& team);

    std::size_t size() const { return ids_.size(); }
    // The id at each rank, and the rank of each id.
    std::span<const std::uint32_t> ids() const { return ids_; }
    std::span<const std::uint32_t> ranks() const { return ranks_; }
    // True if every id is its rank, so that ascending ids are sorted.
    bool ids_are_ranks() const { return ids_are_ranks_; }

    // The number of points of the resource space that have objects, and the number of each id's point,
    // ascending by key. They order objects as keys do, in the smallest space.
    std::uint32_t points() const { return points_; }
    std::span<const std::uint32_t> point_of() const { return point_of_; }

  private:
    std::vector<std::uint32_t> ids_;
    std::vector<std::uint32_t> ranks_;
    std::vector<std::uint32_t> point_of_;
    std::uint32_t points_ = 0;
    bool ids_are_ranks_ = true;
};

}  // namespace swath
