#pragma once
#include <cstdint>
#include <vector>

#include "client/partition/sort_first.h"

namespace swath {

// KD-split (Samanta, Zheng, Funkhouser, Li and Singh 1999, "Load balancing for multi-projector rendering
// systems"; sort-first). Regions start as the bounds of all boxes and are cut where the work per server of
// the objects on the left part comes closest to that on the right part; an object that crosses the cut counts
// on both sides. Of cuts that are equally close: the one nearest to where the region's length divides in
// proportion to the servers, then the lower one. A region of a single pixel cannot be cut.
//
// Positions are pixels, so a region's boxes are counted along its axis instead of sorted. Work must sum to
// less than 2^53, so that times kMaxServers it fits in 64 bits.
class KdSplit final : public SortFirst {
  private:
    Rect first_region(const PartitionInput& input) override;
    int cut(std::span<const Item> items, const Rect& region, std::size_t axis,
            const SplitServers& servers) override;

    // By pixel from the region's lower end: the work that begins and that ends there. Kept between cuts.
    std::vector<std::uint64_t> begins_;
    std::vector<std::uint64_t> ends_;
};

}  // namespace swath
