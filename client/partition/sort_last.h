#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "client/partition/partitioner.h"
#include "client/partition/sweep.h"

namespace swath {

// Sort-last with an interleaved grid of tiles (Neumann's "object partition with block distribution" as in
// Samanta 2000, section 7.4). Groups come from the hybrid's two-line sweep, here in model space along the
// longest side of the group's 3-D box, with triangles as work. They are made once for a number of servers,
// whatever the view. Objects are sorted once along all axes; dividing keeps the order. Tiles are squares of
// 80 pixels, dealt out so that neighbours in both directions have different owners.
class SortLast final : public Partitioner {
  public:
    explicit SortLast(std::span<const Object> objects);
    FramePlan partition(const PartitionInput& input) override;

  private:
    struct Split;  // the objects along one axis, in the form that sweep() asks for

    // The same objects in several orders: by id, and along each axis by upper end ascending and by lower end
    // descending. Equal ones go by id.
    struct Orders {
        std::vector<ObjectId> by_id;
        std::array<std::vector<ObjectId>, 3> from_left;
        std::array<std::vector<ObjectId>, 3> from_right;
    };

    // Divides the objects at [begin, end) of all orders, and reorders them there.
    void divide(Orders& orders, std::size_t begin, std::size_t end, std::size_t first_server,
                std::size_t servers);
    // Moves the left objects to the front of [begin, end); both sides keep their order. Returns where the
    // right ones begin.
    std::size_t separate(std::vector<ObjectId>& order, std::size_t begin, std::size_t end);

    std::vector<Object> objects_;
    Orders sorted_;  // of all objects
    std::vector<Side> sides_;
    std::vector<ObjectId> right_;  // scratch
    // groups_[rank], ascending; made again when the number of servers changes.
    std::vector<std::vector<ObjectId>> groups_;
};

}  // namespace swath
