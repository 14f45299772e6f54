#include "client/partition/kd_split.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace swath {

Rect KdSplit::first_region(const PartitionInput& input) {
    return input.objects.empty() ? input.view.viewport() : bounds_of(input.objects);
}

int KdSplit::cut(std::span<const Item> items, const Rect& region, std::size_t axis,
                 const SplitServers& servers) {
    const int low = low_of(region, axis);
    const int high = high_of(region, axis);
    const int length = high - low;
    if (length < 2) return high;

    begins_.assign(static_cast<std::size_t>(length) + 1, 0);
    ends_.assign(static_cast<std::size_t>(length) + 1, 0);
    std::uint64_t right = 0;
    for (const Item& item : items) {
        begins_[static_cast<std::size_t>(std::max(item.low[axis] - low, 0))] += item.work;
        ends_[static_cast<std::size_t>(std::min(item.high[axis] - low, length))] += item.work;
        right += item.work;
    }
    const auto middle =
        static_cast<int>(static_cast<std::size_t>(length) * servers.left / (servers.left + servers.right));
    std::uint64_t left = 0;
    std::uint64_t closest = std::numeric_limits<std::uint64_t>::max();
    int best = 0;
    for (int at = 1; at < length; ++at) {
        left += begins_[static_cast<std::size_t>(at) - 1];
        right -= ends_[static_cast<std::size_t>(at)];
        // left / servers.left and right / servers.right, without rounding
        const std::uint64_t a = left * servers.right;
        const std::uint64_t b = right * servers.left;
        const std::uint64_t apart = std::max(a, b) - std::min(a, b);
        if (apart < closest || (apart == closest && std::abs(at - middle) < std::abs(best - middle))) {
            closest = apart;
            best = at;
        }
    }
    return low + best;
}

}  // namespace swath
