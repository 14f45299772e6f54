#pragma once
#include <cstdint>
#include <vector>

#include "client/partition/sort_first.h"

namespace swath {

// MAHD, Mueller's mesh-based median cut: sort-first, as Samanta 2000, section 7.3, compares with. A mesh of
// 16-pixel squares covers the screen, and every object spreads its work evenly over the cells that its box
// touches. The bounds of the touched cells are cut along the grid line that makes the larger load per server
// of the two sides smallest; of equal lines along the lowest.
//
// Loads are integers, in units of the smallest fraction of a triangle that 64 bits allow, so that a plan is
// the same on every machine; an object's share of a cell is rounded down. A region of a single cell cannot be
// cut. Objects without work touch no cells; if no object has any, the region is the viewport.
//
// A cut takes time proportional to the region's cells along one axis: loads come from a summed-area table.
class Mahd final : public SortFirst {
  public:
    // The edge of a cell. The paper does not give it; 16 reproduces its Table 1 best, 32 does not.
    static constexpr int kCellPixels = 16;

  private:
    Rect first_region(const PartitionInput& input) override;
    int cut(std::span<const Item> items, const Rect& region, std::size_t axis,
            const SplitServers& servers) override;

    // The load of the cells in [x0, x1) by [y0, y1).
    std::uint64_t load(const Rect& cells) const;

    // sums_[x + y * stride_]: the load of the cells left of x and below y.
    std::vector<std::uint64_t> sums_;
    std::size_t stride_ = 0;
};

}  // namespace swath
