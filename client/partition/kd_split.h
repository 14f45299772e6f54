#pragma once
#include <cstdint>
#include <vector>

#include "client/partition/sort_first.h"

namespace swath {

// KD-split: sort-first (Samanta, Zheng, Funkhouser, Li and Singh 1999, "Load balancing for multi-projector
// rendering systems"). Regions start as the bounds of all boxes. Each is cut where the work per server on the
// left comes closest to that on the right; an object that crosses the cut counts on both sides. Of equally
// close cuts it takes the one nearest to where the region's length divides in proportion to the servers, then
// the lower one. A region of a single pixel cannot be cut.
//
// Positions are pixels, so boxes are counted along the axis instead of sorted. Work must sum to less than
// 2^53, so that times kMaxServers it fits in 64 bits.
class KdSplit final : public SortFirst {
  private:
    Rect first_region(const PartitionInput& input) override;
    int cut(std::span<const Item> items, const Rect& region, std::size_t axis,
            const SplitServers& servers) override;

    // The work that begins and that ends at each pixel, from the region's lower end. Scratch, kept between
    // cuts.
    std::vector<std::uint64_t> begins_;
    std::vector<std::uint64_t> ends_;
};

}  // namespace swath
