#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "common/base/instruction_set.h"
#include "common/base/thread_team.h"
#include "common/published/resource/counting_sort.h"
#include "common/published/resource/key_order.h"
#include "common/published/resource/radix_sort.h"
#include "common/published/resource/rank_bitmap.h"

namespace swath {

// The way in which visible objects were sorted.
enum class SortMethod {
    kNone,        // they were in order: ids are ranks, or all are visible
    kRankBitmap,  // see RankBitmap
    kCounting,    // see CountingSort
    kRadix,       // see RadixSort
};
std::string_view name_of(SortMethod method);  // "none", "bitmap", "counting", "radix"

// Sorts the visible objects of a fixed set by their resources, each frame by the method that is cheapest for
// their number. The answer does not depend on it. One thread at a time. The team must outlive it and be idle
// when it is called.
class ResourceSorter {
  public:
    // keys[id] is the object's key in its ResourceSpace.
    ResourceSorter(std::span<const std::uint32_t> keys, ThreadTeam& team,
                   InstructionSet set = best_instruction_set());
    ResourceSorter(const ResourceSorter&) = delete;
    ResourceSorter& operator=(const ResourceSorter&) = delete;

    // Sorts `visible`, ascending ids, each once, by (key, id). Valid until the next call and as long as
    // `visible`.
    std::span<const std::uint32_t> sort(std::span<const std::uint32_t> visible);

    // The method for so many visible objects, and the one that sort() used last.
    SortMethod method_for(std::size_t visible) const;
    SortMethod method() const { return method_; }

    const KeyOrder& order() const { return order_; }

  private:
    KeyOrder order_;
    RankBitmap bitmap_;
    CountingSort counting_;
    RadixSort radix_;
    SortMethod method_ = SortMethod::kNone;
};

}  // namespace swath
