#include "client/partition/sort_first.h"

namespace swath {

FramePlan SortFirst::partition(const PartitionInput& input) {
    FramePlan plan = begin_plan(input, items_);
    divide(0, items_.size(), first_region(input), input.view.viewport(), plan.servers);
    return plan;
}

void SortFirst::divide(std::size_t begin, std::size_t end, const Rect& region, const Rect& tile,
                       std::span<ServerShare> servers) {
    const std::size_t count = end - begin;
    if (servers.size() == 1) {
        ServerShare& share = servers.front();
        share = share_of({items_.data() + begin, count}, tile);
        // Part of each object lies in the tile, so these are the bounds of those parts.
        share.content = intersect(share.content, tile);
        return;
    }
    const std::size_t axis = longer_axis(region);
    const SplitServers split(servers.size());
    const int at = cut({items_.data() + begin, count}, region, axis, split);
    const Halves regions(region, axis, at);
    const Halves tiles(tile, axis, at);

    // The right side's items go behind all others, the left side's close up; both keep their order. Every
    // item is written to both, and only the counts say where it belongs: a branch on that would be
    // mispredicted.
    if (items_.size() < end + count + 1) items_.resize(end + count + 1);
    Item* left = items_.data() + begin;
    Item* right = items_.data() + end;
    const bool has_left = !tiles.left.empty();
    const bool has_right = !tiles.right.empty();
    for (std::size_t i = begin; i < end; ++i) {
        const Item item = items_[i];
        *left = item;
        left += has_left && item.low[axis] < at ? 1 : 0;
        *right = item;
        right += has_right && item.high[axis] > at ? 1 : 0;
    }
    const auto left_end = static_cast<std::size_t>(left - items_.data());
    const auto right_end = static_cast<std::size_t>(right - items_.data());
    divide(end, right_end, regions.right, tiles.right, servers.subspan(split.left));
    divide(begin, left_end, regions.left, tiles.left, servers.first(split.left));
}

}  // namespace swath
