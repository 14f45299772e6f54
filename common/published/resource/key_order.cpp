#include "common/published/resource/key_order.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "common/base/check.h"
#include "common/published/resource/radix_sort.h"

namespace swath {

KeyOrder::KeyOrder(std::span<const std::uint32_t> keys, ThreadTeam& team)
    : ids_(keys.size()), ranks_(keys.size()), point_of_(keys.size()) {
    if (keys.empty()) return;
    CHECK(keys.size() <= std::size_t{std::numeric_limits<std::uint32_t>::max()});
    std::iota(ranks_.begin(), ranks_.end(), 0u);  // every id, ascending
    RadixSort sort(keys, std::uint64_t{*std::ranges::max_element(keys)} + 1, team);
    std::ranges::copy(sort.sort(ranks_), ids_.begin());
    std::uint32_t last_key = keys[ids_[0]];
    for (std::uint32_t rank = 0; rank < ids_.size(); ++rank) {
        const std::uint32_t id = ids_[rank];
        ranks_[id] = rank;
        ids_are_ranks_ &= id == rank;
        points_ += keys[id] != last_key;
        last_key = keys[id];
        point_of_[id] = points_;
    }
    ++points_;
}

}  // namespace swath
