#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "client/partition/partitioner.h"

namespace swath {

// Hybrid, MAHD and KD-split divide the screen recursively; these are the parts they share.

// An object on its way down the recursion. [0] is x, [1] is y; pixels.
struct Item {
    int low[2];
    int high[2];
    std::uint64_t work;
    ObjectId id;
    bool visible;
};

// Fills `items` with the input's objects by id, and returns a plan whose shares are empty. CHECKs the limits
// of `input`.
FramePlan begin_plan(const PartitionInput& input, std::vector<Item>& items);

// One server's share: the tile, and all of the items, which are ordered by id. Its content bounds their
// boxes.
ServerShare share_of(std::span<const Item> items, const Rect& tile);

Rect bounds_of(std::span<const ProjectedObject> objects);

// The longer axis of a region; x when equal. Rect::width() would be 0 for a region without pixels, whose
// sides still say where its tile is long.
inline std::size_t longer_axis(const Rect& region) {
    return region.x1 - region.x0 >= region.y1 - region.y0 ? 0 : 1;
}

inline int low_of(const Rect& rect, std::size_t axis) { return axis == 0 ? rect.x0 : rect.y0; }
inline int high_of(const Rect& rect, std::size_t axis) { return axis == 0 ? rect.x1 : rect.y1; }

struct Halves {
    Rect left;
    Rect right;
    Halves(const Rect& rect, std::size_t axis, int cut) : left(rect), right(rect) {
        (axis == 0 ? left.x1 : left.y1) = cut;
        (axis == 0 ? right.x0 : right.y0) = cut;
    }
};

}  // namespace swath
