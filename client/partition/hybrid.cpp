#include "client/partition/hybrid.h"

#include <algorithm>

namespace swath {
namespace {

// Counting looks at every possible key. With more keys per item than this, comparing is faster.
constexpr std::size_t kSparseKeys = 6;

// Half-way between the lines, rounded up, in [low, high].
int cut_between(const SweepLines<int>& lines, int low, int high) {
    return std::clamp((lines.left + lines.right + 1) >> 1, low, high);
}

}  // namespace

struct Hybrid::Split {
    std::span<const Item> items;
    std::size_t axis;
    int upper(std::uint32_t i) const { return items[i].high[axis]; }
    int lower(std::uint32_t i) const { return items[i].low[axis]; }
    std::uint64_t work(std::uint32_t i) const { return items[i].work; }
};

FramePlan Hybrid::partition(const PartitionInput& input) {
    FramePlan plan = begin_plan(input, items_);
    right_items_.resize(items_.size());
    from_left_.resize(items_.size());
    from_right_.resize(items_.size());
    sides_.resize(items_.size());
    const Rect viewport = input.view.viewport();
    divide(items_, items_.empty() ? viewport : bounds_of(input.objects), viewport, plan.servers);
    return plan;
}

void Hybrid::divide(std::span<Item> items, const Rect& region, const Rect& tile,
                    std::span<ServerShare> servers) {
    if (servers.size() == 1) {
        servers.front() = share_of(items, tile);
        return;
    }
    const std::size_t axis = longer_axis(region);
    const SplitServers split(servers.size());
    sort_along(items, axis);
    const std::span<Side> sides(sides_.data(), items.size());
    std::fill(sides.begin(), sides.end(), Side::kNone);
    const SweepLines<int> ends{low_of(region, axis), high_of(region, axis)};
    const SweepLines<int> lines = sweep(std::span<const std::uint32_t>(from_left_.data(), items.size()),
                                        std::span<const std::uint32_t>(from_right_.data(), items.size()),
                                        Split{items, axis}, split, ends, sides);
    const int cut = cut_between(lines, ends.left, ends.right);
    const std::size_t left_items = separate(items);

    const Halves regions(region, axis, cut);
    const Halves tiles(tile, axis, cut);
    divide(items.first(left_items), regions.left, tiles.left, servers.first(split.left));
    divide(items.subspan(left_items), regions.right, tiles.right, servers.subspan(split.left));
}

void Hybrid::sort_along(std::span<const Item> items, std::size_t axis) {
    if (items.empty()) return;
    const std::size_t count = items.size();
    int low_min = items[0].low[axis];
    int low_max = low_min;
    int high_min = items[0].high[axis];
    int high_max = high_min;
    for (const Item& item : items) {
        low_min = std::min(low_min, item.low[axis]);
        low_max = std::max(low_max, item.low[axis]);
        high_min = std::min(high_min, item.high[axis]);
        high_max = std::max(high_max, item.high[axis]);
    }
    const auto upper_key = [&](const Item& item) {
        return static_cast<std::uint32_t>(item.high[axis] - high_min);
    };
    const auto lower_key = [&](const Item& item) {
        return static_cast<std::uint32_t>(low_max - item.low[axis]);
    };
    const std::size_t upper_range = static_cast<std::size_t>(high_max - high_min) + 1;
    const std::size_t lower_range = static_cast<std::size_t>(low_max - low_min) + 1;

    if (std::max(upper_range, lower_range) > kSparseKeys * count) {
        // Few items far apart: one number holds key and index, and is sorted.
        keys_.resize(count);
        for (std::size_t i = 0; i < count; ++i) keys_[i] = std::uint64_t{upper_key(items[i])} << 32 | i;
        std::sort(keys_.begin(), keys_.end());
        for (std::size_t i = 0; i < count; ++i) from_left_[i] = static_cast<std::uint32_t>(keys_[i]);
        for (std::size_t i = 0; i < count; ++i)
            keys_[i] = std::uint64_t{lower_key(items[i])} << 32 | (count - 1 - i);
        std::sort(keys_.begin(), keys_.end());
        for (std::size_t i = 0; i < count; ++i)
            from_right_[i] = static_cast<std::uint32_t>(count - 1 - (keys_[i] & 0xffff'ffffu));
        return;
    }
    upper_count_.assign(upper_range + 1, 0);
    lower_count_.assign(lower_range + 1, 0);
    for (const Item& item : items) {
        ++upper_count_[upper_key(item) + 1];
        ++lower_count_[lower_key(item) + 1];
    }
    for (std::size_t k = 1; k <= upper_range; ++k) upper_count_[k] += upper_count_[k - 1];
    for (std::size_t k = 1; k <= lower_range; ++k) lower_count_[k] += lower_count_[k - 1];
    for (std::size_t i = 0; i < count; ++i)
        from_left_[upper_count_[upper_key(items[i])]++] = static_cast<std::uint32_t>(i);
    for (std::size_t i = count; i-- > 0;)
        from_right_[lower_count_[lower_key(items[i])]++] = static_cast<std::uint32_t>(i);
}

std::size_t Hybrid::separate(std::span<Item> items) {
    std::size_t left = 0;
    std::size_t right = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (sides_[i] == Side::kLeft)
            items[left++] = items[i];
        else
            right_items_[right++] = items[i];
    }
    std::copy_n(right_items_.begin(), right, items.begin() + static_cast<std::ptrdiff_t>(left));
    return left;
}

}  // namespace swath
