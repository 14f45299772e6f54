#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "client/partition/partitioner.h"

namespace swath {

// What the recursive divisions of the screen share: hybrid, and the sort-first ones.

// An object on its way down the recursion; [0] is x, [1] is y.
struct Item {
    int low[2];
    int high[2];
    std::uint64_t work;
    ObjectId id;
    bool visible;
};

// The input's objects in `items`, by id, and a plan whose shares are empty. CHECKs the limits of `input`.
FramePlan begin_plan(const PartitionInput& input, std::vector<Item>& items);

// One server's part: the tile, and all of the items, whose order is by id. Its content bounds their boxes.
ServerShare share_of(std::span<const Item> items, const Rect& tile);

Rect bounds_of(std::span<const ProjectedObject> objects);

// The axis along which a region is longer, x when equal. Not by Rect::width(): of a region without pixels the
// longer side still says where its tile is long.
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
