#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "client/partition/partitioner.h"
#include "client/partition/sweep.h"

namespace swath {

// Sort-last with an interleaved grid of tiles (Neumann's "object partition with block distribution" as in
// Samanta 2000, section 7.4). Groups come from the hybrid's two-line sweep in model space, along the longest
// side of the group's 3-D box, with triangles as work: once per number of servers, whatever the view. Objects
// are sorted once, along all axes; dividing keeps the order. Tiles are squares of 80 pixels dealt out so that
// neighbours in both directions have different owners.
class SortLast final : public Partitioner {
  public:
    explicit SortLast(std::span<const Object> objects);
    FramePlan partition(const PartitionInput& input) override;

  private:
    struct Split;  // the objects along an axis, as sweep() asks for them

    // The same objects in several orders: by id, and along each axis by upper end ascending and by lower end
    // descending, equal ones by id.
    struct Orders {
        std::vector<ObjectId> by_id;
        std::array<std::vector<ObjectId>, 3> from_left;
        std::array<std::vector<ObjectId>, 3> from_right;
    };

    // Divides the objects at [begin, end) of all orders, which it leaves in pieces.
    void divide(Orders& orders, std::size_t begin, std::size_t end, std::size_t first_server,
                std::size_t servers);
    // Moves those on the left to the front of [begin, end), both sides in their old order; returns where the
    // right ones begin.
    std::size_t separate(std::vector<ObjectId>& order, std::size_t begin, std::size_t end);

    std::vector<Object> objects_;
    Orders sorted_;  // of all objects
    std::vector<Side> sides_;
    std::vector<ObjectId> right_;  // scratch
    // groups_[server], ascending; for groups_.size() servers. Made again when that number changes.
    std::vector<std::vector<ObjectId>> groups_;
};

}  // namespace swath
