#include "common/published/resource/resource_sorter.h"

#include "common/base/check.h"

namespace swath {
namespace {

// The bitmap costs something for every object, the others only for visible ones, but more for each. Measured
// on one core with one, three and ten million objects: they cost the same where one object in 16 (1 million)
// to one in 11 (10 million) is visible; on either side the difference grows slowly. It hardly moves with the
// instruction set.
constexpr std::size_t kObjectsPerVisible = 12;
// Counting takes one pass where radix takes two, but clears and adds up a counter for each point: it wins
// when fewer points than objects are visible. And it writes to as many places as there are points: with 128
// KiB of counters the nearest caches still hold both, with 512 KiB (131,072 points) radix was twice as fast
// from some hundred thousand visible objects up.
constexpr std::uint32_t kFewPoints = 1 << 15;

}  // namespace

std::string_view name_of(SortMethod method) {
    switch (method) {
        case SortMethod::kNone:
            return "none";
        case SortMethod::kRankBitmap:
            return "bitmap";
        case SortMethod::kCounting:
            return "counting";
        case SortMethod::kRadix:
            return "radix";
    }
    CHECK(false);
    return {};
}

ResourceSorter::ResourceSorter(std::span<const std::uint32_t> keys, ThreadTeam& team, InstructionSet set)
    : order_(keys, team),
      bitmap_(order_, team, set),
      counting_(order_.point_of(), order_.points(), team),
      radix_(order_.point_of(), order_.points(), team) {}

SortMethod ResourceSorter::method_for(std::size_t visible) const {
    if (order_.ids_are_ranks() || visible == order_.size()) return SortMethod::kNone;
    if (visible >= order_.size() / kObjectsPerVisible) return SortMethod::kRankBitmap;
    if (order_.points() <= kFewPoints && visible >= order_.points()) return SortMethod::kCounting;
    return SortMethod::kRadix;
}

std::span<const std::uint32_t> ResourceSorter::sort(std::span<const std::uint32_t> visible) {
    method_ = method_for(visible.size());
    switch (method_) {
        case SortMethod::kNone:
            return order_.ids_are_ranks() ? visible : order_.ids();
        case SortMethod::kRankBitmap:
            return bitmap_.sort(visible);
        case SortMethod::kCounting:
            return counting_.sort(visible);
        case SortMethod::kRadix:
            return radix_.sort(visible);
    }
    CHECK(false);
    return {};
}

}  // namespace swath
