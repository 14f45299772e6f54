#pragma once
#include <vector>

#include "client/partition/division.h"
#include "client/partition/sweep.h"

namespace swath {

// MAHD and KD-split share this. A region is cut in two across its longer side, floor(n/2) servers go left,
// until each part is one server's. Tiles start as the whole viewport and are cut at the same places, so
// background is owned too. A server draws every object whose box overlaps its tile, limited to the tile:
// objects on several tiles are drawn several times and no pixel is swapped.
//
// A region that cannot be cut goes to the left servers; the right ones get what of its tile lies beyond it,
// background or nothing, and no objects if their tile is empty.
//
// O(M log N) besides finding the cuts, where M counts an object once for every part that it overlaps.
class SortFirst : public Partitioner {
  public:
    FramePlan partition(const PartitionInput& input) final;

  protected:
    // Not empty, within the viewport.
    virtual Rect first_region(const PartitionInput& input) = 0;
    // Says where to cut `region` along `axis`, its longer one: between its ends, or at its upper end if it
    // cannot be cut. `items` are the objects on the region's tile.
    virtual int cut(std::span<const Item> items, const Rect& region, std::size_t axis,
                    const SplitServers& servers) = 0;

  private:
    // Divides items_[begin, end). May overwrite the items behind them.
    void divide(std::size_t begin, std::size_t end, const Rect& region, const Rect& tile,
                std::span<ServerShare> servers);

    std::vector<Item> items_;  // kept between frames so that a frame allocates only its plan
};

}  // namespace swath
