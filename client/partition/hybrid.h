#pragma once
#include <cstdint>
#include <vector>

#include "client/partition/division.h"
#include "client/partition/sweep.h"

namespace swath {

// The hybrid sort-first and sort-last partition (Samanta 2000, section 5). A recursive two-line sweep over
// the objects' boxes on the screen makes a server's tile and its group together, so that few pixels of a
// group lie on other servers' tiles.
//
// Where the paper is silent: a region is cut across its longer side (in x when equal), half-way between the
// final lines; floor(n/2) servers go left. Regions start as the bounds of all boxes and decide axis and cut.
// Tiles start as the whole viewport and are cut at the same places, so background is owned too. A region that
// cannot be cut leaves one side an empty tile. Objects at the same place go left by ascending and right by
// descending id, which keeps each group's triangles together in memory.
//
// O(M log N) for M objects and N servers: keys are pixels and are sorted by counting.
class Hybrid final : public Partitioner {
  public:
    FramePlan partition(const PartitionInput& input) override;

  private:
    struct Split;  // the items along one axis, in the form that sweep() asks for

    void divide(std::span<Item> items, const Rect& region, const Rect& tile, std::span<ServerShare> servers);
    void sort_along(std::span<const Item> items, std::size_t axis);
    // Moves the left items to the front; both sides keep their order. Returns the number of left items.
    std::size_t separate(std::span<Item> items);

    // Scratch, kept between frames so that a frame allocates only its plan.
    std::vector<Item> items_;
    std::vector<Item> right_items_;
    std::vector<std::uint32_t> from_left_;
    std::vector<std::uint32_t> from_right_;
    std::vector<std::uint32_t> upper_count_;
    std::vector<std::uint32_t> lower_count_;
    std::vector<std::uint64_t> keys_;
    std::vector<Side> sides_;
};

}  // namespace swath
