#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/base/thread_team.h"

namespace swath {

// Where each object stands when all are sorted by (key, id): what can be known beforehand of keys that do not
// change. An object's rank is its number in that order, so sorting visible objects is finding their ranks in
// ascending order (RankBitmap), and whoever numbers his objects by rank need not sort at all. Immutable.
class KeyOrder {
  public:
    KeyOrder(std::span<const std::uint32_t> keys, ThreadTeam& team);

    std::size_t size() const { return ids_.size(); }
    // The id at each rank, and the rank of each id.
    std::span<const std::uint32_t> ids() const { return ids_; }
    std::span<const std::uint32_t> ranks() const { return ranks_; }
    // Ids are ranks: what is ascending is sorted.
    bool ids_are_ranks() const { return ids_are_ranks_; }

    // The points of the resource space that have any objects, numbered by ascending key; and of each id, its
    // point's number. They order objects as the keys do, in a space as small as can be.
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
