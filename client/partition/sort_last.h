#pragma once
#include <cstdint>
#include <vector>

#include "client/partition/partitioner.h"

namespace swath {

// Sort-last with an interleaved grid of tiles (Neumann's "object partition with block distribution" as in
// Samanta 2000, section 7.4). Groups come from the hybrid's two-line sweep in model space, along the longest
// side of the group's 3-D box, with triangles as work: once per number of servers, whatever the view. Tiles
// are squares of 80 pixels dealt out so that neighbours in both directions have different owners.
class SortLast final : public Partitioner {
  public:
    explicit SortLast(std::span<const Object> objects);
    FramePlan partition(const PartitionInput& input) override;

  private:
    struct Split;  // the objects of one split along its axis, as sweep() asks for them

    void divide(std::vector<ObjectId> group, std::size_t first_server, std::size_t servers);

    std::vector<Object> objects_;
    // groups_[server], ascending; for groups_.size() servers. Made again when that number changes.
    std::vector<std::vector<ObjectId>> groups_;
};

}  // namespace swath
