#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/base/instruction_set.h"
#include "common/base/sharing.h"
#include "common/base/thread_team.h"
#include "common/published/resource/key_order.h"
#include "common/published/resource/scratch.h"

namespace swath {

// Sorts by marking each visible object's rank in a bitmap and reading the marks in order. This is counting
// sort with counters of one bit in a space in which every object is a point of its own. Each member of the
// team marks its share in a bitmap of its own, then merges all bitmaps in a range of ranks, as the papers
// merge R into M. It reads every object's bit, so it is for frames that see more than a few per cent. In
// frames that see more than half it marks what they do not see.
//
// `order` and `team` must outlive it. One thread at a time.
class RankBitmap {
  public:
    explicit RankBitmap(const KeyOrder& order, ThreadTeam& team, InstructionSet set = best_instruction_set(),
                        SharingMode mode = SharingMode::kWhenItPays);

    // Sorts `visible`, ascending ids below order.size(), each once, by (key, id). Valid until the next call.
    std::span<const std::uint32_t> sort(std::span<const std::uint32_t> visible);

  private:
    struct Kernel {
        void (*merge)(std::uint64_t* into, std::uint64_t* from, std::size_t count);
        void (*invert)(std::uint64_t* words, std::size_t count);
        std::size_t (*count)(const std::uint64_t* words, std::size_t count);
        void (*expand)(std::uint64_t* words, std::size_t count, const std::uint32_t* values,
                       std::uint32_t* out, std::size_t room);
    };
    static Kernel kernel_for(InstructionSet set);
    void mark(std::span<const std::uint32_t> ids, std::uint64_t* bitmap) const;
    void mark_gaps(std::span<const std::uint32_t> ids, std::uint32_t begin, std::uint32_t end,
                   std::uint64_t* bitmap) const;

    const KeyOrder& order_;
    ThreadTeam& team_;
    Sharing sharing_;
    Kernel kernel_;
    std::vector<std::vector<std::uint64_t>> bitmaps_;  // of each member, clear between calls
    std::vector<std::size_t> firsts_;
    Scratch<std::uint32_t> sorted_;
};

}  // namespace swath
